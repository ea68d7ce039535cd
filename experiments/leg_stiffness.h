#pragma once

#include "model/simulate.h"

namespace hoplab {

/// Chord stiffness k [N/m] of `thesis` and `no_slip` at a leg angle [rad] and chord length [m] of a
/// stance: M3 in the reading of the parameters' variant (M35, M36), at r_d = l/(2 cos alpha) by
/// default, which is l/2 on the toe.
double ChordStiffness(const Parameters<double>& p, double leg_angle, double length);

/// Chord stiffness [N/m] of a loaded leg at a leg angle [rad] and chord length [m]: the
/// above under `thesis` and `no_slip`, M3 under the others; k of a straight leg.
double StanceStiffness(const SimulationRequest& request, double leg_angle, double length);

}  // namespace hoplab
