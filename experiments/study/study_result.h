#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/hopping_run.h"

namespace hoplab {

// What comes out of a reproduction: values only, for the command and for tests.

enum class StudyVerdict {
  kReproduced,
  kOnlyUnderSettings,  // not with the study's own settings, but with others, which are named
  kNotReproduced
};
std::string_view NameOf(StudyVerdict verdict);

/// A figure by its name, "steady_error", and unit.
struct StudyNumber {
  std::string name;
  double value;
  std::string unit;
};

/// Something that can be told true or false by figures.
struct StudyCheck {
  std::string statement;  // with the bound it is held against
  bool holds = false;
  std::vector<StudyNumber> numbers;
};

/// A printed number beside ours. NaN: there is none (no convergence); two of them agree.
struct ComparedNumber {
  std::vector<StudyNumber> at;  // the cell: E, start speed ...
  std::string quantity, unit;
  double published, ours;
  double tolerance;  // how far apart the two may be, in the same unit
  bool agrees() const;
};

/// A column of data that is written to a file or plotted.
struct StudyColumn {
  std::string name;   // as in the file's header, unit included
  std::string label;  // "horizontal speed"
  std::string unit;
};

/// A published table and ours.
struct StudyTable {
  std::string name, title;
  std::vector<StudyNumber> settings;
  std::vector<StudyColumn> columns;
  std::vector<std::vector<double>> rows;
  std::vector<ComparedNumber> numbers;
  std::vector<StudyNumber> statistics;
  std::vector<StudyCheck> checks;
  StudyVerdict verdict = StudyVerdict::kNotReproduced;
};

/// One curve of a figure.
struct StudyCurve {
  std::string label;
  std::optional<CaptionSettings> settings;  // absent: not a run of the hopper
  std::string outcome;
  double end_time_s = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<double>> rows;  // in the order of the figure's columns
};

/// A figure's data. Lines: the first column across, the second up. Surface: the first two columns
/// are the plane, each further one a surface over it.
struct StudyFigure {
  enum class Kind { kLines, kSurface };
  std::string name, title;
  Kind kind = Kind::kLines;
  std::vector<StudyColumn> columns;
  std::vector<StudyCurve> curves;
  std::vector<StudyNumber> numbers;  // what can be told in one number
};

/// How a claim fares with other settings than the study's.
struct ClaimAlternative {
  std::string setting;
  std::vector<bool> holds;  // one a check
};

/// A claim of the study's text, taken apart into checks.
struct StudyClaim {
  std::string name, statement;
  std::vector<StudyCheck> checks;  // with the study's settings
  std::vector<ClaimAlternative> alternatives;
  StudyVerdict verdict = StudyVerdict::kNotReproduced;
  std::string remark;                // what the figures say, where the verdict alone misleads
  std::vector<StudyNumber> numbers;  // behind the remark
  std::vector<StudyColumn> columns;  // a table behind it; empty where there is none
  std::vector<std::vector<double>> rows;
};

/// Reproduced where every check holds; only under settings where one alternative makes all of them
/// hold; else not.
StudyVerdict VerdictOf(const std::vector<StudyCheck>& checks,
                       const std::vector<ClaimAlternative>& alternatives);

}  // namespace hoplab
