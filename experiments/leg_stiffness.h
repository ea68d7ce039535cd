#pragma once

#include "model/simulate.h"

namespace hoplab {

/// Chord stiffness [N/m] of a loaded leg at a leg angle [rad] and chord length [m]: M3, at the
/// deformed radius under `thesis` (or as its variant has it, M35, M36) and `no_slip`; k of a
/// straight leg.
double StanceStiffness(const SimulationRequest& request, double leg_angle, double length);

}  // namespace hoplab
