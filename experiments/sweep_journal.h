#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/line_journal.h"
#include "experiments/sweep.h"

namespace hoplab {

/// A row as a line of text that reads back bit for bit, without a line end: what the journal holds
/// and what ranks send each other.
std::string LineOfRow(int index, const SweepRow& row);
/// Nothing for a line that is torn or not of this plan.
std::optional<std::pair<int, SweepRow>> RowOfLine(std::string_view line, const SweepPlan& plan);

/// The rows of a sweep that are done, on disk as they come, so that an interrupted sweep goes on
/// where it was. One process writes it.
class SweepJournal {
 public:
  /// Opens or begins the journal; rows that stand there are kept, a torn last one is cut off.
  /// Throws InputError if the rows belong to other settings (`discard`: they are thrown away) or
  /// another process is writing.
  SweepJournal(std::filesystem::path file, const SweepPlan& plan, const std::string& version,
               bool discard);

  /// Adds a row; it is on its way to the disk when this returns. Throws InputError if it cannot be
  /// written.
  void Add(int index, const SweepRow& row);
  /// Adds a line for who looks into the file: `# text`.
  void Note(const std::string& text);
  const std::vector<std::optional<SweepRow>>& rows() const { return rows_; }
  std::vector<int> Missing() const;
  int done() const { return done_; }
  const std::filesystem::path& file() const { return lines_.file(); }
  /// Deletes the file: its rows stand elsewhere now.
  void Remove() { lines_.Remove(); }

 private:
  void Keep(std::string_view line);

  const SweepPlan& plan_;
  std::vector<std::optional<SweepRow>> rows_;
  int done_ = 0;
  LineJournal lines_;
};

/// "0-11, 40": ascending indices with their gaps.
std::string RangesText(const std::vector<int>& indices);

}  // namespace hoplab
