#include "datasets/trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/check.h"
#include "base/input_error.h"
#include "base/text.h"
#include "datasets/input_spec.h"
#include "datasets/key_advice.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {

constexpr std::size_t kMaxColumns = 64;
constexpr Range kTimeRange = Within(1e10, "s");  // a clock that counts from 1970 is fine

// Hands out the lines of a text one by one, whatever ends them: LF, CRLF, CR.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  // The next line that is neither blank nor a comment; false at the end.
  bool Next(std::string_view* line) {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      *line = Trim(rest_.substr(0, end));
      const bool two = rest_.substr(end, 2) == "\r\n";
      rest_.remove_prefix(std::min(rest_.size(), end + (two ? 2 : 1)));
      ++number_;
      if (!line->empty() && line->front() != '#') return true;
    }
    return false;
  }
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

void SplitCells(std::string_view line, std::vector<std::string_view>* cells) {
  cells->clear();
  while (true) {
    const std::size_t end = std::min(line.find(','), line.size());
    std::string_view cell = Trim(line.substr(0, end));
    // Spreadsheets may quote every cell.
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
      cell = Trim(cell.substr(1, cell.size() - 2));
    cells->push_back(cell);
    if (end == line.size()) return;
    line.remove_prefix(end + 1);
  }
}

class TraceParser {
 public:
  TraceParser(std::string_view text, const std::string& place) : lines_(text), place_(place) {}

  Trace Parse() {
    std::string_view line;
    if (!lines_.Next(&line))
      throw InputError({place_, "", "is empty; must have a row of column names and samples",
                        "Begin with time_s,body_x_m,... and one row for each sample."});
    SplitCells(line, &cells_);
    ReadHeader();
    while (lines_.Next(&line)) {
      SplitCells(line, &cells_);
      ReadRow();
    }
    if (trace_.time_s.empty())
      Fail("", "has column names but no samples", "Add one row for each sample.");
    return std::move(trace_);
  }

 private:
  [[noreturn]] void Fail(const std::string& value, const std::string& rule,
                         const std::string& remedy) const {
    throw InputError({place_ + ":" + std::to_string(lines_.number()), value, rule, remedy});
  }

  void ReadHeader() {
    std::vector<std::string> known = ChannelNames();
    known.insert(known.begin(), "time_s");
    for (const InputKind id : {InputKind::kBodyForceX, InputKind::kBodyForceY})
      known.emplace_back(InfoOf(id).key);
    if (cells_[0] != "time_s") {
      std::string remedy = "The first row names the columns, time in seconds first.";
      if (cells_.size() == 1 && cells_[0].find_first_of(";\t") != std::string_view::npos)
        remedy = "Separate the cells by commas and write decimals with a point.";
      else if (WrongUnitAdvice(cells_[0], known))
        remedy = "Rename it to time_s and give the times in s.";
      Fail("column " + Printable(cells_[0]), "the first column must be time_s", remedy);
    }
    if (cells_.size() > kMaxColumns)
      Fail(std::to_string(cells_.size()) + " columns",
           "must have at most " + std::to_string(kMaxColumns), "Remove columns.");
    for (std::size_t i = 1; i < cells_.size(); ++i) {
      const std::string name(cells_[i]);
      const std::string shown = "column " + Printable(name);
      if (name.empty())
        Fail("column " + std::to_string(i + 1), "has no name", "Name or remove the column.");
      if (name == "time_s" || trace_.Find(name) != nullptr)
        Fail(shown, "stands twice in the first row", "Remove or rename one of the two.");
      const std::optional<Channel> id = ChannelFromName(name);
      if (!id) {
        // Names such as "contact" have no unit, so a column without one may be anything.
        if (const auto advice = WrongUnitAdvice(name, known, true))
          Fail(shown, advice->rule, advice->remedy);
      }
      trace_.columns.push_back({name, {}});
      channels_.push_back(id);
    }
  }

  void ReadRow() {
    if (cells_.size() != trace_.columns.size() + 1)
      Fail(std::to_string(cells_.size()) + " cells",
           "must have " + std::to_string(trace_.columns.size() + 1) + ", one for each column",
           "Look for a missing or a stray comma.");
    ReadTime();
    for (std::size_t i = 0; i < trace_.columns.size(); ++i) ReadSample(i);
  }

  double ReadNumber(const std::string& name, std::string_view cell) const {
    const std::optional<double> value = ParseDouble(cell);
    if (!value)
      Fail(name + " = " + Printable(cell), "is not a number",
           "Write a number with a decimal point, or leave the cell empty if it is missing.");
    return *value;
  }

  void ReadTime() {
    const std::string_view cell = cells_[0];
    const double time = cell.empty() ? std::nan("") : ReadNumber("time_s", cell);
    if (std::isnan(time))
      Fail("time_s = " + Printable(cell), "every row must have a time", "Remove the row.");
    const std::string shown = "time_s = " + FormatDouble(time);
    if (!kTimeRange.Contains(time))
      Fail(shown, "must be in " + kTimeRange.Text(), RangeRemedy(time, kTimeRange));
    if (!trace_.time_s.empty() && time <= trace_.time_s.back())
      Fail(shown, "must be greater than the time before, " + FormatDouble(trace_.time_s.back()),
           "Sort the rows by time and remove repeated ones; hoplab import --mend-times does.");
    trace_.time_s.push_back(time);
  }

  void ReadSample(std::size_t column) {
    const std::string_view cell = cells_[column + 1];
    std::vector<double>& values = trace_.columns[column].values;
    if (cell.empty()) {
      values.push_back(std::nan(""));
      return;
    }
    const std::string& name = trace_.columns[column].name;
    const double value = ReadNumber(Printable(name), cell);
    values.push_back(value);
    if (std::isnan(value)) return;
    const std::optional<Channel> id = channels_[column];
    const Range range = id ? ChannelRange(*id) : Range{};
    if (id && IsContact(*id) && value != 0 && value != 1)
      Fail(name + " = " + Printable(cell), "must be 0 or 1",
           "Write 1 while the leg is on the ground.");
    if (!range.Contains(value))
      Fail(Printable(name) + " = " + Printable(cell),
           std::isfinite(value) ? "must be in " + range.Text() : "must be a finite number",
           std::isfinite(value) ? RangeRemedy(value, range)
                                : "Leave the cell empty if the sample is missing.");
  }

  Lines lines_;
  const std::string& place_;
  std::vector<std::string_view> cells_;
  std::vector<std::optional<Channel>> channels_;
  Trace trace_;
};

bool SameSample(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

bool TraceColumn::operator==(const TraceColumn& other) const {
  return name == other.name && std::equal(values.begin(), values.end(), other.values.begin(),
                                          other.values.end(), SameSample);
}

const std::vector<double>* Trace::Find(std::string_view name) const {
  for (const TraceColumn& column : columns)
    if (column.name == name) return &column.values;
  return nullptr;
}

Trace ParseTraceCsv(std::string_view bytes, const std::string& place) {
  return TraceParser(CheckText(bytes, place), place).Parse();
}

std::string FormatTraceCsv(const Trace& trace) {
  std::string text = "time_s";
  for (const TraceColumn& column : trace.columns) {
    HOPLAB_CHECK(column.values.size() == trace.time_s.size());
    text += "," + column.name;
  }
  text += "\n";
  for (std::size_t i = 0; i < trace.time_s.size(); ++i) {
    text += FormatDouble(trace.time_s[i]);
    for (const TraceColumn& column : trace.columns) {
      text += ",";
      if (!std::isnan(column.values[i])) text += FormatDouble(column.values[i]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace hoplab
