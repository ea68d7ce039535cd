#pragma once

#include "tests/support/robot_requests.h"

namespace hoplab::testing {

/// The robot of RobotParametersFor on straight legs of 18 cm; motors held at 0.1 rad.
inline Parameters<double> RodParametersFor(int legs) {
  Parameters<double> p = RobotParametersFor(legs);
  p.l0 = 0.18;
  p.k = 4000.0;
  RobotParameters<double>& robot = *p.robot;
  robot.straight_legs = true;
  robot.lateral_stiffness = 2e4;
  for (int i = 0; i < legs; ++i) robot.angle[i] = 0.1;
  return p;
}

/// Another drop with each seed: heights, speeds, pitch and angles of the motors.
inline SimulationRequest RandomRodDrop(Parameters<double> p, unsigned seed, double horizon) {
  std::mt19937 random(seed);
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < p.robot->legs; ++i) p.robot->angle[i] = in(-0.3, 0.3);
  return RobotDrop(
      p, {0.0, in(0.2, 0.26), in(-0.3, 0.5), in(-0.2, 0.2), in(-0.06, 0.06), in(-0.4, 0.4)},
      horizon);
}

}  // namespace hoplab::testing
