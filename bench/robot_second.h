#pragma once

#include <span>

#include "model/simulate.h"

namespace hoplab::bench {

/// One second of a robot on two legs of 10 g that pronks by a clock (experiments/pronking.yaml),
/// 1e-9 relative; none falls. With the first `directions` (at most 20) of its parameters and
/// initial states.
SimulationRequest RobotSecond(int directions = 0, double leg_mass_kg = 0.010);

}  // namespace hoplab::bench
