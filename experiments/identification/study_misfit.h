#pragma once

#include <array>

#include "experiments/identification/study_runs.h"

namespace hoplab {

/// What a misfit is made of: energy (6.5), stiffness ranges (6.3, 6.4), times of the damped tables
/// (6.2, 6.4) and of the undamped ones (6.1, 6.3).
enum class StudyPart { kEnergy, kStiffness, kDampedTimes, kUndampedTimes };
inline constexpr int kStudyPartCount = 4;
std::string_view NameOf(StudyPart part);

/// One number a part.
using StudyWeights = std::array<double, kStudyPartCount>;
inline constexpr StudyWeights kAllParts = {1.0, 1.0, 1.0, 1.0};
inline constexpr StudyWeights kEnergyAlone = {1.0, 0.0, 0.0, 0.0};

/// Sizes a difference from the print is measured in: what this project calls a reproduced number.
/// An undamped time is told by its rank alone, so that its unit is a few hops.
inline constexpr double kEnergyUnit = 0.3;        // percentage points
inline constexpr double kStiffnessUnit = 0.03;    // of the printed number
inline constexpr double kDampedTimeUnit = 0.5;    // s, one hop
inline constexpr double kUndampedTimeUnit = 2.0;  // s

/// Mean squares of the differences in these units, a part each: finite everywhere. A jump that
/// falls counts as 10 points off, a run that ends early as stiffness off by a factor of e and times
/// off by `kMissingTime`, the more the earlier it ends. Times are those of the reading that does
/// best on both parts together, by `weights`.
struct StudyMisfit {
  std::array<double, kStudyPartCount> parts{};
  int reading = 0;  // place of the reading of the times

  double Total(const StudyWeights& weights = kAllParts) const;
};
StudyMisfit MisfitOf(const StudyRuns& runs, const StudyData& data,
                     const std::vector<ConvergenceReading>& readings,
                     const StudyWeights& weights = kAllParts);

/// Differences whose sum of squares is that misfit by one reading, in the order of the data.
std::vector<double> ResidualsOf(const StudyRuns& runs, const StudyData& data,
                                const ConvergenceReading& reading,
                                const StudyWeights& weights = kAllParts);

/// The energy part alone.
double EnergyMisfit(const std::vector<double>& percent, const StudyData& data);

/// What the readings look at.
RunWants WantsOf(const std::vector<ConvergenceReading>& readings);

/// One number of a table beside ours, and how much of the misfit of its part comes from it.
struct PullingCell {
  StudyTableId table;
  std::string at, quantity, unit;
  double printed, ours;
  double share;  // of the sum of squares of its part
};
/// All of them, the greatest share first. Missing ones count as MisfitOf counts them.
std::vector<PullingCell> PullingCells(const StudyRuns& runs, const StudyData& data,
                                      const ConvergenceReading& reading);

}  // namespace hoplab
