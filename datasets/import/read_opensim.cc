// OpenSim's text formats. TRC: five rows of header, then frame, time and x, y, z of each marker.
// MOT and STO: a header of key=value lines up to `endheader`, a row of labels, then the samples; in
// a typed table (DataType=Quaternion) each sample is a tuple.

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

class OpenSimReader {
 protected:
  OpenSimReader(std::string bytes, const std::string& name, const char* format) {
    table_.file = name;
    table_.format = format;
    table_.texts.push_back(std::move(bytes));
    lines_ = SplitLines(CheckText(table_.texts.back(), table_.file));
  }

  [[noreturn]] void Fail(std::size_t line, const std::string& value, const std::string& rule,
                         const std::string& remedy) const {
    const std::size_t number = lines_.empty() ? 1 : std::min(line, lines_.size() - 1) + 1;
    throw InputError({table_.file + ":" + std::to_string(number), value, rule, remedy});
  }

  // Tabs keep empty cells; without them any run of blanks separates.
  static Cells Split(std::string_view line) {
    return SplitCells(line, line.find('\t') == line.npos ? ' ' : '\t');
  }

  void ReadRows(std::size_t first) {
    for (std::size_t i = first; i < lines_.size(); ++i) {
      if (Trim(lines_[i].text).empty()) continue;
      AddRow(lines_[i], Split(lines_[i].text), &table_);
    }
  }

  void CheckCount(std::size_t line, const std::string& key, std::string_view stated,
                  std::size_t present, const std::string& things) const {
    const std::optional<double> count = ParseDouble(stated);
    if (!count)
      Fail(line, key + " = " + Printable(stated), "is not a number", "Export the file again.");
    if (*count == static_cast<double>(present)) return;
    Fail(line, key + " = " + Printable(stated),
         "the file has " + std::to_string(present) + " " + things,
         "The file was cut off or edited: export it again, or correct the number.");
  }

  Table table_;
  std::vector<TextLine> lines_;
};

class TrcReader : OpenSimReader {
 public:
  TrcReader(std::string bytes, const std::string& name)
      : OpenSimReader(std::move(bytes), name, "OpenSim TRC") {}

  Table Read() {
    if (lines_.empty() || !lines_[0].text.starts_with("PathFileType"))
      Fail(0, lines_.empty() ? "" : Printable(lines_[0].text, 30),
           "the first line of a TRC must begin with PathFileType", "Export the markers as TRC.");
    if (lines_.size() < 5)
      Fail(lines_.size(), std::to_string(lines_.size()) + " lines",
           "a TRC has five lines of header", "The file was cut off: export it again.");
    ReadSettings();
    ReadMarkers();
    ReadRows(5);
    if (table_.lines.empty())
      Fail(5, "", "has a header and no samples", "Export the markers again.");
    const auto frames = settings_.find("NumFrames");
    if (frames != settings_.end())
      CheckCount(2, "NumFrames", frames->second, table_.lines.size(), "rows of samples");
    return std::move(table_);
  }

 private:
  void ReadSettings() {
    const Cells keys = Split(lines_[1].text), values = Split(lines_[2].text);
    for (std::size_t i = 0; i < keys.size() && i < values.size(); ++i)
      settings_[std::string(keys[i])] = values[i];
    for (const char* key : {"NumMarkers", "Units"})
      if (settings_[key].empty())
        Fail(2, key, "is missing in lines 2 and 3", "Export the markers again as TRC.");
    const std::string units(settings_["Units"]);
    const std::optional<LogUnit> unit = FindUnit(units);
    if (!unit || unit->dimension != Dimension::kLength)
      Fail(2, "Units = " + Printable(units), "is no unit of length",
           "Known: " + Join(UnitNames(Dimension::kLength)) + ".");
    table_.units = {{Dimension::kTime, "s"}, {Dimension::kLength, units}};
  }

  void ReadMarkers() {
    const Cells cells = Split(lines_[3].text);
    if (cells.size() < 2 || !cells[0].starts_with("Frame") || cells[1] != "Time")
      Fail(3, Printable(lines_[3].text, 30), "line 4 of a TRC must begin with Frame#, Time",
           "Export the markers again as TRC.");
    Cells markers;
    std::copy_if(cells.begin() + 2, cells.end(), std::back_inserter(markers),
                 [](std::string_view cell) { return !cell.empty(); });
    CheckCount(2, "NumMarkers", settings_["NumMarkers"], markers.size(), "markers in line 4");
    table_.columns.push_back({"Frame#", "", {}});
    table_.columns.push_back({"Time", "", {}});
    for (const std::string_view marker : markers)
      for (const char* axis : {".X", ".Y", ".Z"})
        table_.columns.push_back({std::string(marker) + axis, "", {}});
  }

  std::map<std::string, std::string_view> settings_;
};

class StorageReader : OpenSimReader {
 public:
  StorageReader(std::string bytes, const std::string& name)
      : OpenSimReader(std::move(bytes), name, "OpenSim storage") {}

  Table Read() {
    const std::size_t labels = ReadHeader();
    Cells names = Split(lines_[labels].text);
    std::erase_if(names, [](std::string_view label) { return label.empty(); });
    MakeColumns(names);
    if (parts_.empty())
      ReadRows(labels + 1);
    else
      ReadTypedRows(labels + 1, names);
    if (table_.lines.empty())
      Fail(labels, "", "has labels and no samples", "Export the motion again.");
    CheckStated({"nColumns", "datacolumns"}, names.size(), "columns");
    CheckStated({"nRows", "datarows"}, table_.lines.size(), "rows of samples");
    AddAngles(names);
    return std::move(table_);
  }

 private:
  struct Stated {
    std::string_view value;
    std::size_t line;
  };

  // Reads up to endheader; returns the line of the labels.
  std::size_t ReadHeader() {
    std::size_t end = 0;
    for (; end < lines_.size() && Trim(lines_[end].text) != "endheader"; ++end) {
      const std::string_view line = Trim(lines_[end].text);
      // `nRows=12`; older files have `datarows 12`.
      const std::size_t between = std::min(line.find('='), line.find(' '));
      if (between < line.size())
        header_[std::string(line.substr(0, between))] = {Trim(line.substr(between + 1)), end};
    }
    if (end == lines_.size())
      Fail(0, "", "has no line endheader, as every MOT and STO file has",
           "Check that the file is one; if it is plain CSV, say --format csv.");
    ReadDataType();
    table_.units = {{Dimension::kTime, "s"},
                    {Dimension::kLength, "m"},
                    {Dimension::kVelocity, "m/s"},
                    {Dimension::kForce, "N"},
                    {Dimension::kTorque, "N m"}};
    ReadAngleUnit();
    for (++end; end < lines_.size() && Trim(lines_[end].text).empty(); ++end) {
    }
    if (end >= lines_.size())
      Fail(end, "", "ends after its header; must have a row of labels and samples",
           "Export the motion again.");
    return end;
  }

  // What the cells of a typed table hold; nothing for plain numbers.
  void ReadDataType() {
    const auto type = header_.find("DataType");
    if (type == header_.end() || type->second.value == "double") return;
    if (type->second.value == "Quaternion")
      parts_ = {".W", ".X", ".Y", ".Z"};
    else if (type->second.value == "Vec3" || type->second.value == "UnitVec3")
      parts_ = {".X", ".Y", ".Z"};
    else
      Fail(type->second.line, "DataType = " + Printable(type->second.value),
           "only tables of double, Quaternion, Vec3 and UnitVec3 are read",
           "Flatten the table before writing it: TimeSeriesTable.flatten().");
  }

  void MakeColumns(const Cells& names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string name(names[i]);
      if (parts_.empty() || i == 0) {
        table_.columns.push_back({name, "", {}});
        continue;
      }
      // Components of a turn have no unit; those of a vector may be lengths or anything else.
      for (const char* part : parts_)
        table_.columns.push_back({name + part, parts_.size() == 4 ? "1" : "", {}});
    }
    if (parts_.size() == 3) table_.units = {{Dimension::kTime, "s"}};
  }

  // Rows whose cells, but for the time, are tuples: 0.99,0.01,0,0.14.
  void ReadTypedRows(std::size_t first, const Cells& names) {
    for (std::size_t i = first; i < lines_.size(); ++i) {
      if (Trim(lines_[i].text).empty()) continue;
      const Cells tuples = Split(lines_[i].text);
      Cells cells;
      for (std::size_t c = 0; c < tuples.size(); ++c) {
        if (c == 0) {
          cells.push_back(tuples[c]);
          continue;
        }
        const Cells parts = SplitCells(tuples[c], ',');
        if (parts.size() != parts_.size() && !IsMissing(tuples[c]))
          Fail(i, (c < names.size() ? std::string(names[c]) + " = " : "") + Printable(tuples[c]),
               "must be " + std::to_string(parts_.size()) + " numbers, separated by commas",
               "Export the table again.");
        for (std::size_t p = 0; p < parts_.size(); ++p)
          cells.push_back(parts.size() == parts_.size() ? parts[p] : std::string_view());
      }
      AddRow(lines_[i], cells, &table_);
    }
  }

  void AddAngles(const Cells& names) {
    for (std::size_t i = 1; parts_.size() == 4 && i < names.size(); ++i) {
      const std::size_t w = 1 + 4 * (i - 1);
      AddTurnAngles(std::string(names[i]), w, w + 1, w + 2, w + 3, &table_);
    }
  }

  void ReadAngleUnit() {
    const auto stated = header_.find("inDegrees");
    if (stated == header_.end()) return;  // then the user says
    if (stated->second.value != "yes" && stated->second.value != "no")
      Fail(stated->second.line, "inDegrees = " + Printable(stated->second.value),
           "must be yes or no", "Correct the line or export the motion again.");
    table_.units[Dimension::kAngle] = stated->second.value == "yes" ? "deg" : "rad";
  }

  void CheckStated(const std::vector<std::string>& keys, std::size_t present,
                   const std::string& things) const {
    for (const std::string& key : keys) {
      const auto stated = header_.find(key);
      if (stated != header_.end())
        CheckCount(stated->second.line, key, stated->second.value, present, things);
    }
  }

  std::map<std::string, Stated> header_;
  std::vector<const char*> parts_;  // of a typed cell; empty: plain numbers
};

}  // namespace

Table ReadTrc(std::string bytes, const std::string& name) {
  return TrcReader(std::move(bytes), name).Read();
}

Table ReadStorage(std::string bytes, const std::string& name) {
  return StorageReader(std::move(bytes), name).Read();
}

}  // namespace hoplab
