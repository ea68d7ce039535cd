#pragma once

#include "model/simulate.h"

namespace hoplab {

/// Chord stiffness [N/m] of a loaded leg at a leg angle [rad] and chord length [m]: M3; under
/// `thesis` and `no_slip` at the deformed radius r_d = l/(2 cos alpha), l/2 on the toe, or as the
/// parameters' reading has it (M35, M36); k of a straight leg.
double StanceStiffness(const SimulationRequest& request, double leg_angle, double length);

}  // namespace hoplab
