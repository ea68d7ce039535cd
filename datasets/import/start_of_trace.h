#pragma once

#include <optional>
#include <vector>

#include "datasets/mechanism_spec.h"
#include "datasets/trace.h"

namespace hoplab {

/// What a robot's trace tells of its first row.
struct RobotTrial {
  /// Place, pitch and their rates, with how well each is known; absent without x, y and pitch, or
  /// with fewer than 6 samples of one in the first 40 ms.
  std::optional<StateSpec> initial, initial_sigma;
  std::vector<double> angles_rad;  // the motors' first samples; empty unless each leg has one
};

/// Rates are those of parabolas through the first 40 ms. Their sigmas are twice the standard
/// errors, 2 mm, 20 mm/s, 5 mrad and 50 mrad/s at least: a leg that lands early bends the parabola.
RobotTrial StartOfTrace(const Trace& trace, int legs);

}  // namespace hoplab
