#pragma once

#include <random>
#include <string>
#include <vector>

#include "model/simulate.h"

namespace hoplab::testing {

/// A robot of 3 kg on half circles of 9 cm, hips evenly spaced along 24 cm, its motors held at
/// 0.5 rad; undamped, on a ground that holds its feet.
inline Parameters<double> RobotParametersFor(int legs) {
  Parameters<double> p;
  p.m = 3.0;
  p.r = 0.09;
  p.E = 4.0e10;
  p.I = 1.0e-10;
  p.robot = RobotParameters<double>();
  RobotParameters<double>& robot = *p.robot;
  robot.legs = legs;
  robot.pitch_inertia = 0.05;
  robot.rotor_inertia = 1e-3;
  robot.motor_kp = 60.0;
  robot.motor_kd = 0.8;
  robot.E.fill(p.E);
  for (int i = 0; i < legs; ++i) {
    robot.hip_x[i] = legs == 1 ? 0.0 : -0.12 + 0.24 * i / (legs - 1);
    robot.angle[i] = 0.5;
  }
  return p;
}

/// One on three legs that walks by a clock, on a ground that lets its feet slide.
inline Parameters<double> Walking() {
  Parameters<double> p = RobotParametersFor(3);
  RobotParameters<double>& robot = *p.robot;
  robot.control = MotorControl::kClock;
  robot.period = 0.45;
  robot.duty = 0.6;
  robot.sweep = 0.8;
  robot.offset = 0.25;
  robot.phase = {0.1, 0.6, 0.1};
  robot.torque_limit = 6.0;
  robot.friction = 1.0;
  robot.damping = 4e-4;
  return p;
}

/// An effect with its first parameter at `size`, the others as they are given.
inline EffectSetting EffectOf(const std::string& name, double size) {
  EffectSetting setting = EffectSetting::Null(*FindEffect(name));
  setting.values[0] = size;
  return setting;
}

/// A drop of it: x, y, vx, vy, pitch, pitch rate.
inline SimulationRequest RobotDrop(const Parameters<double>& p, std::vector<double> start,
                                   double horizon) {
  SimulationRequest q;
  q.law = Law::kRobot;
  q.parameters = p;
  q.initial = std::move(start);
  q.horizon = horizon;
  q.integrator.relative_tolerance = 1e-11;
  q.integrator.absolute_tolerance = 1e-12;
  return q;
}

/// A drop of one that walks; none of its legs begins where the clock's pieces meet, and no two of
/// them come to that at once.
inline SimulationRequest WalkingDrop(double horizon) {
  Parameters<double> p = Walking();
  p.robot->phase = {0.1, 0.65, 0.15};
  return RobotDrop(p, {0.0, 0.2, 0.4, 0.0, 0.02, 0.1}, horizon);
}

/// Another drop with each seed: heights, speeds, pitch and angles of the motors.
inline SimulationRequest RandomRobotDrop(Parameters<double> p, unsigned seed, double horizon) {
  std::mt19937 random(seed);
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < p.robot->legs; ++i) p.robot->angle[i] = in(-0.15, 0.8);
  return RobotDrop(
      p, {0.0, in(0.21, 0.28), in(-0.2, 0.5), in(-0.2, 0.2), in(-0.06, 0.06), in(-0.4, 0.4)},
      horizon);
}

}  // namespace hoplab::testing
