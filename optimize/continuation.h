#pragma once

#include <atomic>
#include <vector>

#include "optimize/fixed_point.h"

namespace hoplab {

/// Where a branch of fixed points is followed, in the unit of the parameter.
struct ContinuationOptions {
  double low = 0.0, high = 1.0;
  double first_step = 0.01;  // arc length; the whole range of the parameter is 1
  double max_step = 0.04;
  int max_points = 400;  // in each direction
  FixedPointOptions fixed_point;
  const std::atomic<bool>* stop = nullptr;  // keeps the points found so far
};

/// One point of a branch.
struct BranchPoint {
  double parameter = 0.0;
  FixedPoint fixed_point;
  /// The event sequence is another one than at the point before: an event grazes between them.
  bool sequence_changed = false;
  /// An event is met almost without crossing it, or almost happens: the map is about to lose its
  /// derivative here.
  bool near_grazing = false;
};

/// What the stability does between two points of a branch.
enum class BifurcationKind {
  kFold,  // a multiplier passes +1: two fixed points meet
  kFlip,  // a multiplier passes -1: the gait limps, every second hop alike
  kTorus  // a conjugate pair leaves the unit circle
};
std::string_view NameOf(BifurcationKind kind);
struct Bifurcation {
  BifurcationKind kind = BifurcationKind::kFold;
  double parameter = 0.0;  // linear interpolation between the two points
};

/// Why a branch ends on one side.
enum class BranchEnd {
  kRange,         // the end of the range
  kHopFails,      // the next hop falls, grazes, ...; `outcome` says which
  kNotConverged,  // no fixed point was found near the prediction, however short the step
  kLost,          // what is found near the prediction is another branch's, however short the step
  kPointLimit,
  kStopped
};
std::string_view NameOf(BranchEnd end);

struct Branch {
  std::vector<BranchPoint> points;  // in their order along the branch
  std::vector<Bifurcation> bifurcations;
  BranchEnd first_end = BranchEnd::kRange, last_end = BranchEnd::kRange;
  Outcome first_outcome = Outcome::kHopLimit, last_outcome = Outcome::kHopLimit;
};

/// Follows the fixed point `start` of `map` along a parameter, both ways, by pseudo-arclength:
/// through folds as well. Empty if `start` was not found.
Branch FollowFixedPoint(const ReturnMap& map, const FixedPoint& start,
                        const SensitivityDirection& parameter, const ContinuationOptions& options);

}  // namespace hoplab
