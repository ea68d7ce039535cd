#pragma once

#include <map>
#include <optional>

#include "experiments/identification/study_unit.h"
#include "experiments/line_journal.h"

namespace hoplab {

/// The fits of an identification that are done, on disk as they come, each beside the unit it
/// belongs to, so that an interrupted identification goes on where it was.
class FitJournal {
 public:
  /// `version`: of the program. Throws InputError if the journal cannot be used; a journal of other
  /// data, readings of times or another integrator is another one.
  FitJournal(std::filesystem::path file, const UnitContext& context, const std::string& version,
             bool discard);

  std::optional<StudyFit> Find(const StudyUnit& unit) const;
  void Add(const StudyUnit& unit, const StudyFit& fit);
  std::size_t size() const { return fits_.size(); }
  const LineJournal& lines() const { return lines_; }
  void Remove() { lines_.Remove(); }

 private:
  void Keep(std::string_view line);

  std::map<std::string, StudyFit, std::less<>> fits_;  // by the unit's text
  LineJournal lines_;
};

}  // namespace hoplab
