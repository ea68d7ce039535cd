#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// What the file of a robot says of its motors, their clock and its legs, and what may be otherwise:
// M107 to M111, and the mass of its legs (M82).

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

Parameters<double> SomeRobot() {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->friction = 0.9;
  p.robot->damping = 3e-4;
  p.robot->leg_mass = 0.02;
  p.robot->torque_limit = 5.0;
  return p;
}

struct Stated {
  const char* effect;
  double size;  // of the effect
  void (*state)(RobotParameters<double>& robot);
};

SimulationRequest Drop(const std::string& effect, unsigned seed, double horizon) {
  return effect.starts_with("gait_") ? WalkingDrop(horizon)
                                     : RandomRobotDrop(SomeRobot(), seed, horizon);
}

class RobotStatedValues : public ::testing::TestWithParam<Stated> {};

TEST_P(RobotStatedValues, AreARobotThatIsStatedSo) {
  SimulationRequest q = Drop(GetParam().effect, 3, 0.3);
  const Trajectory plain = Simulate(q);
  const std::array effects = {EffectOf(GetParam().effect, GetParam().size)};
  q.effects = effects;
  const Trajectory changed = Simulate(q);
  q.effects = {};
  GetParam().state(*q.parameters.robot);
  const Trajectory stated = Simulate(q);
  ASSERT_EQ(changed.outcome, stated.outcome);
  ASSERT_EQ(changed.final_state.size(), stated.final_state.size());
  EXPECT_GT(changed.events.size(), 1u);
  EXPECT_GT(std::abs(plain.final_state[4] - stated.final_state[4]), 1e-6);
  for (std::size_t k = 0; k < stated.final_state.size(); ++k)
    EXPECT_NEAR(changed.final_state[k], stated.final_state[k], 1e-12) << k;
}

TEST_P(RobotStatedValues, HaveTheDerivativesOfDifferences) {
  for (const double size : {0.0, GetParam().size}) {
    const std::array effects = {EffectOf(GetParam().effect, size)};
    SimulationRequest q = Drop(GetParam().effect, 2, 0.2);
    q.effects = effects;
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    EXPECT_GE(ExpectRobotExact(q, {}, {D::EffectParameter(0, 0), D::InitialState(1)}), 4) << size;
  }
}

// Whatever duty is stated: none at null, and both parts of a turn stay.
TEST(GaitDutyShift, LeavesWhatIsStatedAndKeepsBothPartsOfATurn) {
  const auto shifted = [](double duty, double shift) {
    Parameters<double> p = Walking();
    p.robot->duty = duty;
    FindEffect("gait_duty_shift")->hooks0.change_parameters(&shift, p);
    return p.robot->duty;
  };
  for (const double duty : {0.005, 0.02, 0.6, 0.98, 0.995}) EXPECT_EQ(shifted(duty, 0.0), duty);
  EXPECT_DOUBLE_EQ(shifted(0.6, -0.03), 0.57);
  EXPECT_DOUBLE_EQ(shifted(0.9, 0.3), 0.98);
  EXPECT_DOUBLE_EQ(shifted(0.2, -0.3), 0.02);
  EXPECT_DOUBLE_EQ(shifted(0.995, 0.1), 0.995);
}

INSTANTIATE_TEST_SUITE_P(
    All, RobotStatedValues,
    ::testing::Values(
        Stated{"rotor_inertia_scale", 0.7,
               [](RobotParameters<double>& r) { r.rotor_inertia *= 1.7; }},
        Stated{"motor_kp_scale", -0.25, [](RobotParameters<double>& r) { r.motor_kp *= 0.75; }},
        Stated{"motor_kd_scale", 0.4, [](RobotParameters<double>& r) { r.motor_kd *= 1.4; }},
        Stated{"torque_limit_loss", 0.2, [](RobotParameters<double>& r) { r.torque_limit *= 0.8; }},
        Stated{"swinging_leg_mass", -0.012, [](RobotParameters<double>& r) { r.leg_mass = 0.008; }},
        Stated{"hub_clamp", 0.004, [](RobotParameters<double>& r) { r.clamp = 0.004; }},
        Stated{"gait_period_scale", 0.05, [](RobotParameters<double>& r) { r.period *= 1.05; }},
        Stated{"gait_duty_shift", -0.03, [](RobotParameters<double>& r) { r.duty -= 0.03; }},
        Stated{"gait_sweep_scale", 0.1, [](RobotParameters<double>& r) { r.sweep *= 1.1; }},
        Stated{"gait_offset_shift", 0.04, [](RobotParameters<double>& r) { r.offset += 0.04; }},
        Stated{"gait_phase_shift", 0.02,
               [](RobotParameters<double>& r) {
                 for (double& phase : r.phase) phase += 0.02;
               }},
        Stated{"gait_phase_shift_2", -0.03,
               [](RobotParameters<double>& r) { r.phase[1] -= 0.03; }}),
    [](const auto& info) { return std::string(info.param.effect); });

}  // namespace
}  // namespace hoplab
