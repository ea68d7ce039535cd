#pragma once

#include <array>
#include <span>

#include "model/simulate.h"

namespace hoplab::bench {

/// The leg of the benchmarks under `law`: m = 1 kg, r = 0.09 m, E = 22 GPa, G = 4 GPa, section
/// 30 mm x 3.8 mm, d = 3 N s/m, touch-down at 30 deg. `straight_leg` is one of about its size and
/// stiffness: k = 2350 N/m, l0 = 0.18 m, touch-down at 15 deg.
Parameters<double> LegParameters(Law law);

/// The first `count` (at most 16) of a fixed list of directions: the parameters E, d, m, r first,
/// then eight more parameters, then the initial state.
std::span<const SensitivityDirection> Directions(int count);

/// Body state (x, y [m], vx, vy [m/s]) where the leg, released at (0, 0.3, 1, 0), touches down.
std::array<double, 4> TouchdownState(Law law);

/// From touch-down through one stance to the next apex. The flight after it is in closed form and
/// costs next to nothing; the lift-off is the event the peers look for.
SimulationRequest StanceRequest(Law law, int directions = 0);
/// From apex to apex, released at (0, 0.3, 1, 0).
SimulationRequest HopRequest(Law law, int directions = 0);
/// Ten hops under the speed controller (a passive damped leg falls before its tenth).
SimulationRequest TenHopRequest(Law law, int directions = 0);

/// Time of the first lift-off [s] since the start; NaN if there was none.
double LiftoffTime(const Trajectory& trajectory);

}  // namespace hoplab::bench
