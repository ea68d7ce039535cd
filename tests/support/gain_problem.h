#pragma once

#include "optimize/gain_search.h"
#include "tests/support/controlled_hopper.h"

namespace hoplab::testing {

/// Touch-down angle [deg] and gain [N s] of the controlled hopper over a wide box: most of it
/// falls, touches down without support or does not settle in 15 s.
inline SearchProblem GainProblem(SearchObjective objective = SearchObjective::kConvergenceTime) {
  SearchProblem problem;
  problem.variables = {{"touchdown_angle_deg", 15.0, 60.0}, {"controller.kp_N_s", 0.5, 12.0}};
  problem.objective = objective;
  problem.constraints.min_speed = 1.3;
  problem.hopper_at = [](std::span<const double> x) {
    Hopper hopper = ControlledHopper();
    hopper.request.parameters.d = 3.0;
    hopper.request.parameters.theta_td = Degrees(x[0]);
    hopper.request.parameters.kp = x[1];
    hopper.request.integrator = {};
    return hopper;
  };
  return problem;
}

}  // namespace hoplab::testing
