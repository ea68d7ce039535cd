#pragma once

#include "optimize/hopper.h"
#include "tests/support/robot_requests.h"

namespace hoplab::testing {

/// A robot with a clock, to be set going; its integrator tight enough for differences.
inline Hopper ClockedRobot(int legs, double period, double duty, double sweep, double offset) {
  Hopper hopper;
  hopper.request.law = Law::kRobot;
  hopper.request.parameters = RobotParametersFor(legs);
  RobotParameters<double>& robot = *hopper.request.parameters.robot;
  robot.control = MotorControl::kClock;
  robot.period = period;
  robot.duty = duty;
  robot.sweep = sweep;
  robot.offset = offset;
  robot.phase = {0.0, 0.0, 0.0, 0.0};
  robot.torque_limit = 15.0;
  robot.friction = 1.0;
  robot.damping = 4e-4;
  hopper.request.parameters.E = 22.0e9;
  hopper.request.parameters.I = 1.8355e-10;
  hopper.request.integrator.relative_tolerance = 1e-12;
  hopper.request.integrator.absolute_tolerance = 1e-13;
  return hopper;
}

/// Three legs, the middle one half a turn behind: experiments/robot-walk.yaml. Its steady stride is
/// stable.
inline Hopper WalkingRobot() {
  Hopper hopper = ClockedRobot(3, 0.54, 0.79, 0.68, 0.32);
  hopper.request.parameters.robot->phase[1] = 0.5;
  hopper.request.initial = {0.0, 0.206, 0.5, 0.0, 0.0, 0.0};
  return hopper;
}

/// The same on straight legs: experiments/robot-straight-walk.yaml. Its steady stride is stable.
inline Hopper WalkingOnRods() {
  Hopper hopper = ClockedRobot(3, 0.445, 0.9, 0.8, 0.13);
  Parameters<double>& p = hopper.request.parameters;
  p.l0 = 0.18;
  p.k = 4000.0;
  p.robot->straight_legs = true;
  p.robot->lateral_stiffness = 2e4;
  p.robot->phase[1] = 0.5;
  hopper.request.initial = {0.0, 0.2, 0.8, 0.0, 0.0, 0.0};
  return hopper;
}

/// Two legs in phase: experiments/pronking.yaml. It falls after some ten strides; the steady stride
/// near them is unstable.
inline Hopper PronkingRobot() {
  Hopper hopper = ClockedRobot(2, 0.268, 0.70, 1.05, 0.28);
  hopper.request.initial = {0.0, 0.198, 0.58, 0.0, 0.0, 0.0};
  return hopper;
}

}  // namespace hoplab::testing
