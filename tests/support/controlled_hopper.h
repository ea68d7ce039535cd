#pragma once

#include <cmath>

#include "optimize/hopper.h"
#include "tests/support/requests.h"

namespace hoplab::testing {

/// The strip leg under the speed controller, damped: it settles on a steady hop.
inline Hopper ControlledHopper(Law law = Law::kLargeDeflection) {
  SimulationRequest q = StripLegRequest(law, Degrees(40.0));
  q.parameters.d = 6.0;
  q.parameters.kp = 4.0;
  q.parameters.v_des = 1.8;
  q.horizon = 15.0;
  q.max_hops = 0;
  q.integrator.relative_tolerance = 1e-13;
  q.integrator.absolute_tolerance = 1e-14;
  return {q, {}};
}

}  // namespace hoplab::testing
