// OptiTrack Motive's CSV export. First line: pairs of key and value. Then rows that name what each
// column belongs to, with `Type`, `Name`, `ID`, `Parent` in the second cell where the version
// writes them; one with Rotation or Position; one that begins Frame, Time (Seconds) and names the
// axes.

#include <algorithm>
#include <map>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/table.h"
#include "datasets/import/text_rows.h"
#include "datasets/import/typed_columns.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {

using Cells = std::vector<std::string_view>;

class MotiveReader {
 public:
  MotiveReader(std::string bytes, const std::string& name) {
    table_.file = name;
    table_.format = "Motive CSV";
    table_.texts.push_back(std::move(bytes));
    lines_ = SplitLines(CheckText(table_.texts.back(), table_.file));
  }

  Table Read() {
    if (lines_.empty() || !lines_[0].text.starts_with("Format Version"))
      Fail(0, lines_.empty() ? "" : Printable(lines_[0].text, 30),
           "the first line of a Motive export must begin with Format Version",
           "Export the take as CSV with header information on; if it is plain CSV, say --format "
           "csv.");
    ReadSettings();
    const std::size_t axes = FindAxes();
    MakeColumns(axes);
    for (std::size_t i = axes + 1; i < lines_.size(); ++i) {
      if (Trim(lines_[i].text).empty()) continue;
      AddRow(lines_[i], SplitCells(lines_[i].text, ','), &table_);
    }
    if (table_.lines.empty())
      Fail(axes, "", "has a header and no samples", "Export the take again.");
    CheckFrames();
    AddAngles();
    return std::move(table_);
  }

 private:
  [[noreturn]] void Fail(std::size_t line, const std::string& value, const std::string& rule,
                         const std::string& remedy) const {
    throw InputError({table_.file + ":" + std::to_string(line + 1), value, rule, remedy});
  }

  void ReadSettings() {
    const Cells pairs = SplitCells(lines_[0].text, ',');
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2)
      settings_[std::string(pairs[i])] = pairs[i + 1];
    const std::string_view units = settings_["Length Units"];
    const std::optional<LogUnit> unit = FindUnit(units);
    if (!unit || unit->dimension != Dimension::kLength)
      Fail(0, "Length Units = " + Printable(units), "is no unit of length",
           "Export again with Meters, Centimeters or Millimeters.");
    table_.units = {
        {Dimension::kTime, "s"}, {Dimension::kLength, unit->name}, {Dimension::kAngle, "deg"}};
  }

  std::size_t FindAxes() const {
    for (std::size_t i = 1; i < lines_.size(); ++i)
      if (lines_[i].text.starts_with("Frame,Time")) return i;
    Fail(lines_.size() - 1, "", "has no row that begins Frame,Time (Seconds)",
         "The file was cut off or edited: export the take again.");
  }

  // The rows between the settings and the axes that hold something.
  std::vector<Cells> RowsAbove(std::size_t axes) const {
    std::vector<Cells> rows;
    for (std::size_t i = 1; i < axes; ++i)
      if (!Trim(lines_[i].text).empty()) rows.push_back(SplitCells(lines_[i].text, ','));
    return rows;
  }

  void MakeColumns(std::size_t axes) {
    const std::vector<Cells> above = RowsAbove(axes);
    if (above.size() < 3)
      Fail(axes, std::to_string(above.size()) + " rows",
           "a Motive export has at least three rows of types, names and Position or Rotation here",
           "Export the take again with header information on.");
    // Versions that leave the second cell blank have types first, then names.
    Cells names = above[1];
    for (const Cells& row : above)
      if (row.size() > 1 && row[1] == "Name") names = row;
    const Cells& kinds = above.back();
    const Cells titles = SplitCells(lines_[axes].text, ',');
    const auto cell = [](const Cells& row, std::size_t i) {
      return i < row.size() ? std::string(row[i]) : std::string();
    };
    for (std::size_t i = 0; i < titles.size(); ++i) {
      std::string name = cell(names, i);
      const std::string kind = cell(kinds, i);
      for (const std::string& part : {kind, std::string(titles[i])})
        if (i > 1 && !part.empty()) name += (name.empty() ? "" : ".") + part;
      if (i < 2) name = std::string(titles[i]);
      table_.columns.push_back({name, "", {}});
      const bool quaternion = kind == "Rotation" && settings_["Rotation Type"] == "Quaternion";
      if (quaternion) table_.columns.back().unit = "1";
    }
  }

  // The turns of quaternions about each axis.
  void AddAngles() {
    for (std::size_t i = 0; i + 3 < table_.columns.size(); ++i) {
      const std::string& name = table_.columns[i].name;
      const bool begins = table_.columns[i].unit == "1" && name.ends_with(".X") &&
                          table_.columns[i + 3].name.ends_with(".W");
      if (begins) AddTurnAngles(name.substr(0, name.size() - 2), i + 3, i, i + 1, i + 2, &table_);
    }
  }

  // A take that was cut off on its way is worse than none.
  void CheckFrames() {
    const std::string_view stated = settings_["Total Exported Frames"];
    const std::optional<double> frames = ParseDouble(stated);
    if (!frames || *frames == static_cast<double>(table_.lines.size())) return;
    Fail(0, "Total Exported Frames = " + Printable(stated),
         "the file has " + std::to_string(table_.lines.size()) + " rows of samples",
         "The file was cut off or edited: export it again, or correct the number.");
  }

  Table table_;
  std::vector<TextLine> lines_;
  std::map<std::string, std::string_view> settings_;
};

}  // namespace

Table ReadMotiveCsv(std::string bytes, const std::string& name) {
  return MotiveReader(std::move(bytes), name).Read();
}

}  // namespace hoplab
