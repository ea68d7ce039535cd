#include "datasets/import/trace_of_table.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/import/decimal.h"
#include "datasets/import/text_rows.h"

namespace hoplab {
namespace {

constexpr Range kTimeRange = Within(1e10, "s");

class TraceBuilder {
 public:
  TraceBuilder(const Table& table, const ColumnMap& map, const TraceOptions& options)
      : table_(table), options_(options) {
    for (const MappedColumn& mapped : map.columns)
      if (!mapped.target.IsTime()) {
        channels_.push_back(&mapped);
      } else {
        time_ = &mapped;
      }
    std::sort(channels_.begin(), channels_.end(),
              [](const MappedColumn* a, const MappedColumn* b) { return a->target < b->target; });
  }

  ImportedTrace Build() {
    trace_.csv = "time_s";
    for (const MappedColumn* mapped : channels_) trace_.csv += "," + TargetName(mapped->target);
    trace_.csv += "\n";
    std::vector<StampedRow> rows = RowsOfCut(CommonLength());
    if (options_.mend_times) Mend(rows);
    for (const StampedRow& row : rows) AddRow(row, rows.front());
    if (trace_.rows == 0)
      throw InputError({table_.file, "", "no row lies within the cut" + CutText(),
                        "The log spans " + FormatDouble(first_s_) + " to " + FormatDouble(last_s_) +
                            " s by its own clock."});
    return std::move(trace_);
  }

 private:
  std::size_t CommonLength() const {
    const MappedColumn& first = time_ != nullptr ? *time_ : *channels_.front();
    const SourceColumn& column = table_.columns[first.column];
    for (const MappedColumn* mapped : channels_) {
      const SourceColumn& other = table_.columns[mapped->column];
      if (other.cells.size() == column.cells.size()) continue;
      throw InputError({table_.file, "column " + Printable(other.name),
                        "has " + std::to_string(other.cells.size()) + " samples and " +
                            Printable(column.name) + " has " + std::to_string(column.cells.size()),
                        "Take columns that were sampled together, or resample one of them."});
    }
    return column.cells.size();
  }

  std::string CutText() const {
    const auto end = [](const std::optional<double>& s) { return s ? FormatDouble(*s) : ""; };
    return " " + end(options_.from_s) + ":" + end(options_.to_s);
  }

  [[noreturn]] void Fail(std::size_t row, const MappedColumn& mapped, std::string_view cell,
                         const std::string& rule, const std::string& remedy) const {
    throw InputError({table_.Place(row),
                      Printable(table_.columns[mapped.column].name) + " = " + Printable(cell), rule,
                      remedy});
  }

  // A number of the log in SI units and with its channel's sign and shift; empty if it is missing.
  std::string SiText(std::size_t row, const MappedColumn& mapped) const {
    const std::string_view cell = table_.columns[mapped.column].cells[row];
    if (IsMissing(cell)) return "";
    const std::optional<double> value = ParseDouble(cell);
    if (!value)
      Fail(row, mapped, cell, "is not a number",
           "Write numbers without units or thousands separators; leave missing ones empty.");
    if (!std::isfinite(*value))
      Fail(row, mapped, cell, "must be a finite number", "Leave the cell empty if it is missing.");
    std::string text = ToSi(cell, mapped.unit);
    if (mapped.negate) text = NegateDecimal(text);
    const auto shift = options_.shifts.find(mapped.target);
    if (shift == options_.shifts.end()) return text;
    return Sum(row, mapped, text, shift->second);
  }

  std::string Sum(std::size_t row, const MappedColumn& mapped, const std::string& text,
                  const std::string& shift) const {
    const std::optional<std::string> sum = AddDecimals(text, shift);
    if (!sum)
      Fail(row, mapped, text, "plus " + shift + " takes more than 36 digits", "Shift by less.");
    return *sum;
  }

  // The rows within the cut, in the order of the log.
  std::vector<StampedRow> RowsOfCut(std::size_t count) {
    std::vector<StampedRow> rows;
    for (std::size_t row = 0; row < count; ++row) {
      StampedRow stamped = Stamped(row);
      const double time = stamped.time_s;
      if (row == 0) first_s_ = time;
      last_s_ = time;
      if (time < options_.from_s.value_or(time) || time > options_.to_s.value_or(time)) continue;
      if (time_ != nullptr && !rows.empty() && !options_.mend_times)
        CheckOrder(row, time, rows.back());
      rows.push_back(std::move(stamped));
    }
    return rows;
  }

  StampedRow Stamped(std::size_t row) const {
    std::string text;
    if (time_ == nullptr) {
      text = FormatDouble(static_cast<double>(row) / *options_.rate_hz);
    } else {
      text = SiText(row, *time_);
      if (text.empty())
        Fail(row, *time_, "", "every row must have a time", "Remove the row or fill its time in.");
      CheckRange(row, text);
    }
    const double time = *ParseDouble(text);
    return {row, std::move(text), time};
  }

  void Mend(std::vector<StampedRow>& rows) {
    const auto same_samples = [&](std::size_t a, std::size_t b) {
      return std::all_of(channels_.begin(), channels_.end(), [&](const MappedColumn* mapped) {
        return SiText(a, *mapped) == SiText(b, *mapped);
      });
    };
    const auto too_far = [&](std::size_t row) {
      Fail(row, *time_, table_.columns[time_->column].cells[row],
           "lies more than " + std::to_string(kFurthestSwap) +
               " rows from where its stamp belongs: the clock was set, the rows were not swapped",
           "Cut the log there with --cut, or sort the rows.");
    };
    if (time_ != nullptr) trace_.mended = MendTimes(rows, same_samples, too_far);
  }

  // A row's time as it is written.
  std::string TimeText(const StampedRow& row, const StampedRow& first) const {
    if (!options_.zero_time) return row.text;
    if (time_ == nullptr)
      return FormatDouble(static_cast<double>(row.row - first.row) / *options_.rate_hz);
    return Sum(row.row, *time_, row.text, NegateDecimal(first.text));
  }

  void CheckRange(std::size_t row, const std::string& text) const {
    if (!kTimeRange.Contains(*ParseDouble(text)))
      Fail(row, *time_, table_.columns[time_->column].cells[row], "must be in " + kTimeRange.Text(),
           "Check its unit in --map.");
  }

  void CheckOrder(std::size_t row, double time, const StampedRow& before) const {
    if (time > before.time_s) return;
    const std::vector<std::string_view>& cells = table_.columns[time_->column].cells;
    Fail(row, *time_, cells[row],
         (time == before.time_s ? "repeats the time before, "
                                : "goes back behind the time before, ") +
             std::string(cells[before.row]),
         "Remove the row, sort the rows by time, cut the log with --cut, or say --mend-times.");
  }

  void AddRow(const StampedRow& stamped, const StampedRow& first) {
    const std::size_t row = stamped.row;
    const std::string time = TimeText(stamped, first);
    std::string line = time;
    for (const MappedColumn* mapped : channels_) {
      const std::string text = SiText(row, *mapped);
      if (text.empty()) ++trace_.missing[mapped->target];
      if (!text.empty()) CheckSample(row, *mapped, *ParseDouble(text));
      line += "," + text;
    }
    trace_.csv += line + "\n";
    if (trace_.rows++ == 0) trace_.first_s = *ParseDouble(time);
    trace_.last_s = *ParseDouble(time);
  }

  void CheckSample(std::size_t row, const MappedColumn& mapped, double value) const {
    const std::string_view cell = table_.columns[mapped.column].cells[row];
    const Range range = TargetRange(mapped.target);
    if (mapped.target.channel && IsContact(*mapped.target.channel) && value != 0 && value != 1)
      Fail(row, mapped, cell, "must be 0 or 1", "Write 1 while the leg is on the ground.");
    if (!range.Contains(value))
      Fail(row, mapped, std::string(cell) + " " + mapped.unit.name, "must be in " + range.Text(),
           "Check its unit in --map, or the line.");
  }

  const Table& table_;
  const TraceOptions& options_;
  const MappedColumn* time_ = nullptr;
  std::vector<const MappedColumn*> channels_;
  double first_s_ = 0, last_s_ = 0;
  ImportedTrace trace_;
};

}  // namespace

ImportedTrace TraceOfTable(const Table& table, const ColumnMap& map, const TraceOptions& options) {
  return TraceBuilder(table, map, options).Build();
}

}  // namespace hoplab
