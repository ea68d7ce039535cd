#include "experiments/sweep_journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>

#include "base/input_error.h"
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
    : file_(std::move(file)), plan_(plan), rows_(static_cast<std::size_t>(plan.size())) {
  std::error_code ignored;
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), ignored);
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0)
    throw InputError({file_.string(), "", "cannot be written: " + std::string(strerror(errno)),
                      "Give another place with --out."});
  try {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      throw InputError({file_.string(), "", "is being written by another sweep",
                        "Wait for it, or give another place with --out."});
    std::ifstream in(file_, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    Load(text, "hoplab-sweep-rows/1 " + version + " " + plan.fingerprint(), discard);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

SweepJournal::~SweepJournal() {
  if (descriptor_ >= 0) close(descriptor_);
}

void SweepJournal::Load(const std::string& text, const std::string& header, bool discard) {
  const std::size_t first_end = text.find('\n');
  const bool same = first_end != text.npos && text.substr(0, first_end) == header;
  const bool fresh = first_end == text.npos;  // empty, or torn in its first line
  if (!same && !fresh && !discard) {
    throw InputError({file_.string(), "",
                      "holds rows of another scenario, other outputs, another seed or another "
                      "version of hoplab",
                      "Finish that sweep, remove the file, give another --out, or --force."});
  }
  if (!same || discard) {
    if (ftruncate(descriptor_, 0) != 0)
      throw InputError({file_.string(), "", "cannot be emptied", ""});
    Write(header + "\n");
    return;
  }
  const std::size_t whole = text.rfind('\n') + 1;  // what follows was torn by the interruption
  if (whole < text.size() && ftruncate(descriptor_, static_cast<off_t>(whole)) != 0)
    throw InputError({file_.string(), "", "cannot be mended", "Remove it."});
  for (std::size_t at = first_end + 1; at < whole;) {
    const std::size_t end = text.find('\n', at);
    if (auto row = RowOfLine(std::string_view(text).substr(at, end - at), plan_)) {
      done_ += !rows_[row->first].has_value();
      rows_[row->first] = std::move(row->second);
    }
    at = end + 1;
  }
}

void SweepJournal::Write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0)
      throw InputError({file_.string(), "", "cannot be written: " + std::string(strerror(errno)),
                        "Make room, then start the same command again."});
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void SweepJournal::Add(int index, const SweepRow& row) {
  const std::string line = LineOfRow(index, row);
  Write(line + "\n");
  done_ += !rows_[index].has_value();
  // As it would be read back, so that an interrupted sweep ends with the very same rows.
  rows_[index] = std::move(RowOfLine(line, plan_)->second);
}

void SweepJournal::Note(const std::string& text) { Write("# " + text + "\n"); }

std::vector<int> SweepJournal::Missing() const {
  std::vector<int> missing;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i]) missing.push_back(static_cast<int>(i));
  }
  return missing;
}

void SweepJournal::Remove() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
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
