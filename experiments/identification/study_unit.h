#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/identification/study_misfit.h"

namespace hoplab {

/// One search of the identification, complete in itself: a reading of the law, what is searched,
/// from where, and what it is measured by.
struct StudyUnit {
  /// The runs a trial point takes: the jumps of 6.5, the steady hops besides, or all tables.
  enum class Runs { kEnergy, kSteady, kTables };
  Runs runs = Runs::kTables;
  StudyReading reading;
  StudyWeights weights = kAllParts;
  std::vector<StudyConstant> free;
  StudyConstants constants{};  // where it starts; those that are not free stay
  /// Half-width of a global search about `constants`, in their logarithms, within their bounds; 0:
  /// a local search from there.
  double box = 0.0;
  std::uint64_t seed = 1;
  int budget = 600;  // evaluations; what is found is polished by no more than as many
  /// Place of the one reading of the times that it is measured by; none: by the best of all.
  std::optional<int> times = std::nullopt;
  bool operator==(const StudyUnit&) const = default;
};
/// A box that holds all of the bounds.
inline constexpr double kWholeBox = 100.0;

/// A reading with its best constants for some runs and weights.
struct StudyFit {
  StudyReading reading;
  StudyConstants constants{};
  double misfit = 0.0;  // weighted sum; NaN where nothing was evaluated
  StudyMisfit parts;
  long evaluations = 0;
};

/// What all units of an identification share.
struct UnitContext {
  StudyData data;
  std::vector<ConvergenceReading> convergence;  // readings of the times to choose from
  IntegratorOptions integrator;
  const std::atomic<bool>* stop = nullptr;  // keeps the best so far
};

/// NLopt's CRS2 where there is a box, then Sbplx, then Ceres: of 6.5 alone with the simulator's
/// sensitivities, else with differences. The same unit gives the same fit.
StudyFit FitUnit(const UnitContext& context, const StudyUnit& unit);

/// The misfit of a hopper by the runs of a unit, its times by the best of the readings.
StudyMisfit MisfitOf(const StudyHopper& hopper, const UnitContext& context, StudyUnit::Runs runs,
                     const StudyWeights& weights);

/// Places of the readings of the times that come closest where the unit begins, `most` at most: by
/// one set of tables.
std::vector<int> LikelyTimes(const UnitContext& context, const StudyUnit& unit, int most);

// Text that reads back bit for bit, one line without its end: what ranks send each other and what a
// journal holds.
std::string TextOf(const StudyUnit& unit);
std::optional<StudyUnit> UnitOfText(std::string_view text);
std::string TextOf(const StudyFit& fit);
std::optional<StudyFit> FitOfText(std::string_view text);

}  // namespace hoplab
