#include "experiments/sweep_journal.h"

#include <charconv>

#include "base/text.h"

namespace hoplab {
namespace {

constexpr char kSeparator = '\t';
constexpr std::size_t kMaxReason = 500;
constexpr std::size_t kFixedCells = 3;  // index, outcome, reason

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t at = line.find(kSeparator);
    cells.push_back(line.substr(0, at));
    if (at == line.npos) return cells;
    line.remove_prefix(at + 1);
  }
}

}  // namespace

std::string LineOfRow(int index, const SweepRow& row) {
  std::string line = std::to_string(index) + kSeparator + row.outcome + kSeparator +
                     Printable(row.reason, kMaxReason);
  for (const double value : row.values) line += kSeparator + FormatDouble(value);
  return line;
}

std::optional<std::pair<int, SweepRow>> RowOfLine(std::string_view line, const SweepPlan& plan) {
  const std::vector<std::string_view> cells = Cells(line);
  if (cells.size() != kFixedCells + plan.outputs().size()) return std::nullopt;
  int index = -1;
  const auto [end, fault] =
      std::from_chars(cells[0].data(), cells[0].data() + cells[0].size(), index);
  if (fault != std::errc() || end != cells[0].data() + cells[0].size()) return std::nullopt;
  if (index < 0 || index >= plan.size()) return std::nullopt;
  SweepRow row{{}, std::string(cells[1]), std::string(cells[2])};
  for (std::size_t i = kFixedCells; i < cells.size(); ++i) {
    const std::optional<double> value = ParseDouble(cells[i]);
    if (!value) return std::nullopt;
    row.values.push_back(*value);
  }
  return std::pair(index, std::move(row));
}

SweepJournal::SweepJournal(std::filesystem::path file, const SweepPlan& plan,
                           const std::string& version, bool discard)
    : plan_(plan),
      rows_(static_cast<std::size_t>(plan.size())),
      lines_(std::move(file), "hoplab-sweep-rows/1 " + version + " " + plan.fingerprint(), discard,
             {"sweep",
              "holds rows of another scenario, other outputs, another seed or another version of "
              "hoplab",
              "Finish that sweep, remove the file, give another --out, or --force."},
             [this](std::string_view line) { Keep(line); }) {}

// As it is read back, so that an interrupted sweep ends with the very same rows.
void SweepJournal::Keep(std::string_view line) {
  auto row = RowOfLine(line, plan_);
  if (!row) return;
  done_ += !rows_[row->first].has_value();
  rows_[row->first] = std::move(row->second);
}

void SweepJournal::Add(int index, const SweepRow& row) {
  const std::string line = LineOfRow(index, row);
  lines_.Add(line);
  Keep(line);
}

void SweepJournal::Note(const std::string& text) { lines_.Add("# " + text); }

std::vector<int> SweepJournal::Missing() const {
  std::vector<int> missing;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i]) missing.push_back(static_cast<int>(i));
  }
  return missing;
}

std::string RangesText(const std::vector<int>& indices) {
  std::string text;
  for (std::size_t i = 0; i < indices.size();) {
    std::size_t last = i;
    while (last + 1 < indices.size() && indices[last + 1] == indices[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(indices[i]);
    if (last > i) text += "-" + std::to_string(indices[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace hoplab
