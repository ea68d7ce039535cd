#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// Torques on a robot's motors that nobody asked for, M101.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// A motor that is held and biased moves as one that is told another angle, from the same state;
// what a lagging one gives of what it is told differs by the bias alone.
TEST(TorqueBias, OfAHeldMotorIsAnotherReference) {
  for (const auto& [play, lag] : {std::pair{0.0, 0.0}, {0.012, 0.0}, {0.0, 5e-6}, {0.0, 0.005}}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.9;
    p.robot->leg_mass = 0.01;
    p.robot->motor_gain = 0.8;
    p.robot->play[1] = play;
    p.robot->motor_lag = lag;
    const double bias = 1.5;
    SimulationRequest q = RandomRobotDrop(p, 3, 0.25);
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    for (double angle : {p.robot->angle[0], p.robot->angle[1] - 0.05}) q.initial.push_back(angle);
    for (double rate : {0.0, 0.0}) q.initial.push_back(rate);
    const std::array effects = {EffectOf("torque_bias_2", bias)};
    q.effects = effects;
    const Trajectory biased = Simulate(q);
    q.effects = {};
    q.parameters.robot->angle[1] += bias / (p.robot->motor_kp * p.robot->motor_gain);
    const Trajectory told = Simulate(q);
    ASSERT_EQ(biased.outcome, Outcome::kCompleted);
    ASSERT_EQ(biased.final_state.size(), told.final_state.size());
    EXPECT_GT(biased.events.size(), 2u);
    const std::size_t given = lag > 1e-3 ? 12 : told.final_state.size();  // where that is a state
    for (std::size_t k = 0; k < told.final_state.size(); ++k) {
      const double by = k == given + 1 ? bias / p.robot->motor_gain : 0.0;
      EXPECT_NEAR(biased.final_state[k], told.final_state[k] - by, 1e-9) << k << ", lag " << lag;
    }
  }
}

// Of all motors it is that of each.
TEST(TorqueBias, OfAllMotorsIsThatOfEach) {
  SimulationRequest q = RobotDrop(Walking(), {0.0, 0.2, 0.4, 0.0, 0.02, 0.1}, 0.3);
  const std::array all = {EffectOf("torque_bias", 0.2)};
  const std::array each = {EffectOf("torque_bias_1", 0.2), EffectOf("torque_bias_2", 0.2),
                           EffectOf("torque_bias_3", 0.2)};
  const Trajectory plain = Simulate(q);
  q.effects = all;
  const Trajectory one = Simulate(q);
  q.effects = each;
  const Trajectory three = Simulate(q);
  EXPECT_EQ(one.final_state, three.final_state);
  EXPECT_GT(std::abs(one.final_state[0] - plain.final_state[0]), 1e-4);
}

TEST(TorqueBias, HasTheDerivativesOfDifferences) {
  for (const double size : {0.0, 0.4}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.9;
    p.robot->damping = 3e-4;
    p.robot->rotor_inertia = 4e-3;
    const std::array effects = {EffectOf("torque_bias_1", size), EffectOf("torque_bias", 0.1)};
    SimulationRequest q = RandomRobotDrop(p, 2, 0.2);
    q.effects = effects;
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    EXPECT_GE(ExpectRobotExact(q, {},
                               {D::EffectParameter(0, 0), D::EffectParameter(1, 0),
                                D::Parameter(ParameterId::kMotorKp), D::InitialState(1)}),
              6)
        << size;
  }
}

}  // namespace
}  // namespace hoplab
