#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "optimize/stride_map.h"

namespace hoplab {

/// What a stride is called, from when its legs stand.
enum class GaitKind {
  kPronk,   // all legs at once, and all off the ground at once
  kCrouch,  // all legs at once, never all off the ground
  kBound,   // two legs one after the other, and both off the ground at times
  kWalk,    // legs one after the other, at no time all off the ground
  kRun      // three legs or more one after the other, all off the ground at times
};
std::string_view NameOf(GaitKind kind);

/// When a leg stands within a stride.
struct LegUse {
  double duty = 0.0;    // share of the stride on the ground
  double middle = 0.0;  // of its stance, in shares of the stride, from that of leg 1; in [0, 1)
};

/// What a stride does and costs.
struct StrideMeasures {
  GaitKind kind = GaitKind::kWalk;
  double speed = std::numeric_limits<double>::quiet_NaN();  // m/s
  /// Mechanical work that the motors give (what they brake is not given back) over weight times
  /// way: int sum max(0, tau_i dpsi_i/dt) dt/((M + sum m) g |x|).
  double cost_of_transport = std::numeric_limits<double>::quiet_NaN();
  double peak_torque = std::numeric_limits<double>::quiet_NaN();  // of any motor [N m]
  double flight_share = 0.0;                                      // no leg on the ground
  /// How far the middle of a leg's stance lies from that of leg 1 at most, in shares of the stride;
  /// up to 0.5.
  double legs_apart = 0.0;
  std::vector<LegUse> legs;
};

/// Of the stride from `state`, which must return.
StrideMeasures MeasureStride(const StrideMap& map, const SectionState& state);

}  // namespace hoplab
