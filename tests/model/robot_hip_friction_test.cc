#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/robot_requests.h"

// Friction of a robot's hips, M99.

namespace hoplab {
namespace {

using namespace testing;

EffectSetting Friction(const std::string& name, double size) {
  EffectSetting setting = EffectSetting::Null(*FindEffect(name));
  setting.values[0] = size;
  return setting;
}

// A motor that is held and has no limit brakes its rotor by k_d of its rate: so does the hip.
TEST(HipFriction, AViscousOneIsADerivativeGainOfHeldMotors) {
  for (const double leg_mass : {0.0, 0.02}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.8;
    p.robot->damping = 3e-4;
    p.robot->leg_mass = leg_mass;
    SimulationRequest q = RobotDrop(p, {0.0, 0.21, 0.4, -0.2, 0.03, 0.2}, 0.3);
    q.parameters.robot->motor_kd = p.robot->motor_kd + 0.3;
    const Trajectory braked = Simulate(q);
    ASSERT_EQ(braked.outcome, Outcome::kCompleted);
    const auto differs_by = [&](const std::vector<EffectSetting>& effects) {
      q.parameters.robot->motor_kd = p.robot->motor_kd;
      q.effects = effects;
      const Trajectory run = Simulate(q);
      double most = 0.0;
      for (std::size_t k = 0; k < run.final_state.size(); ++k)
        most = std::max(most, std::abs(run.final_state[k] - braked.final_state[k]));
      return most;
    };
    EXPECT_LT(differs_by({Friction("hip_viscous_friction", 0.3)}), 1e-8);
    EXPECT_LT(differs_by({Friction("hip_viscous_friction_1", 0.3),
                          Friction("hip_viscous_friction_2", 0.3)}),
              1e-8);
    EXPECT_GT(differs_by({Friction("hip_viscous_friction_1", 0.3)}), 1e-3);
    EXPECT_GT(differs_by({}), 1e-3);
  }
}

// In the air a rotor without a controller is braked alone: J dw/dt = -b w - c tanh(w/width).
TEST(HipFriction, BrakesAFreeRotorAsItsClosedFormSays) {
  Parameters<double> p = RobotParametersFor(2);
  RobotParameters<double>& robot = *p.robot;
  robot.motor_kp = robot.motor_kd = 0.0;
  const double begins[] = {6.0, -2.0}, time = 0.12, J = robot.rotor_inertia, b = 8e-3, c = 4e-3;
  SimulationRequest q =
      RobotDrop(p, {0.0, 2.0, 0.3, 0.0, 0.0, 0.1, 0.5, 0.4, begins[0], begins[1], 0.0, 0.0}, time);
  const auto final_rate = [&](const EffectSetting& friction, int leg) {
    const std::array effects = {friction};
    q.effects = effects;
    const Trajectory run = Simulate(q);
    EXPECT_EQ(run.outcome, Outcome::kCompleted);
    return run.final_state[static_cast<std::size_t>(8 + leg)];
  };
  for (int leg : {0, 1}) {
    const std::string other = std::to_string(2 - leg);
    EXPECT_NEAR(final_rate(Friction("hip_viscous_friction", b), leg),
                begins[leg] * std::exp(-b * time / J), 1e-9);
    EXPECT_NEAR(final_rate(Friction("hip_viscous_friction_" + other, b), leg), begins[leg], 1e-9);
    const double w = kHipFrictionWidth;
    EXPECT_NEAR(final_rate(Friction("hip_coulomb_friction", c), leg),
                w * std::asinh(std::sinh(begins[leg] / w) * std::exp(-c * time / (J * w))), 1e-8);
    EXPECT_NEAR(final_rate(Friction("hip_coulomb_friction_" + other, c), leg), begins[leg], 1e-9);
  }
}

}  // namespace
}  // namespace hoplab
