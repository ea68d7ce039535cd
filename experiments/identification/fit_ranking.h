#pragma once

#include <vector>

#include "experiments/identification/study_unit.h"

namespace hoplab {

/// Best first; a fit that a stop cut short, of misfit NaN, last.
void SortByMisfit(std::vector<StudyFit>& fits);

/// The first `count`.
std::vector<StudyFit> Best(const std::vector<StudyFit>& fits, int count);

/// Of sorted fits the first of each reading, `count` at most and none of misfit NaN. BestLaws: the
/// first of each law, whatever the rule of lift-off, since with a mass at the toe there is one.
std::vector<StudyFit> BestReadings(const std::vector<StudyFit>& fits, int count);
std::vector<StudyFit> BestLaws(const std::vector<StudyFit>& fits, int count);

}  // namespace hoplab
