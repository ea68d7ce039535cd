#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// Legs of a robot that sit on their motors askew (M100), and a pitch that is read askew.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// A leg that is held askew is one that is held elsewhere, and its encoder reads what it is told.
TEST(LegZeroOffset, OfAHeldMotorIsAnotherReference) {
  for (const double play : {0.0, 0.012}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.9;
    p.robot->damping = 3e-4;
    p.robot->leg_mass = 0.01;
    p.robot->play[1] = play;
    const double askew = 0.04;
    SimulationRequest q = RandomRobotDrop(p, 3, 0.25);
    const std::array rows = {0.05, 0.12, 0.2};
    const std::array channels = {Channel::kLegAngle1, Channel::kLegAngle2, Channel::kHipTorque2};
    q.row_times = rows;
    q.channels = channels;
    const std::array effects = {EffectOf("leg_zero_offset_2", askew)};
    q.effects = effects;
    const Trajectory off = Simulate(q);
    q.effects = {};
    q.parameters.robot->angle[1] += askew;
    const Trajectory told = Simulate(q);
    ASSERT_EQ(off.outcome, Outcome::kCompleted);
    ASSERT_EQ(off.final_state.size(), told.final_state.size());
    for (std::size_t k = 0; k < told.final_state.size(); ++k)
      EXPECT_NEAR(off.final_state[k], told.final_state[k], 1e-10) << k;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      EXPECT_NEAR(off.samples[3 * row], told.samples[3 * row], 1e-10);
      EXPECT_NEAR(off.samples[3 * row + 1], told.samples[3 * row + 1] - askew, 1e-10);
      EXPECT_NEAR(off.samples[3 * row + 2], told.samples[3 * row + 2], 1e-8);
    }
  }
}

TEST(LegZeroOffset, OfAllLegsIsAnotherOffsetOfTheClock) {
  SimulationRequest q = RobotDrop(Walking(), {0.0, 0.2, 0.4, 0.0, 0.02, 0.1}, 0.4);
  const std::array effects = {EffectOf("leg_zero_offset", -0.03)};
  q.effects = effects;
  const Trajectory off = Simulate(q);
  q.effects = {};
  q.parameters.robot->offset -= 0.03;
  const Trajectory told = Simulate(q);
  ASSERT_EQ(off.outcome, Outcome::kCompleted);
  for (std::size_t k = 0; k < told.final_state.size(); ++k)
    EXPECT_NEAR(off.final_state[k], told.final_state[k], 1e-10) << k;
}

TEST(LegZeroOffset, HasTheDerivativesOfDifferences) {
  for (const double size : {0.0, 0.03}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.9;
    p.robot->damping = 3e-4;
    p.robot->rotor_inertia = 4e-3;
    const std::array effects = {EffectOf("leg_zero_offset_1", size),
                                EffectOf("sensor_offset_pitch", 0.01)};
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

TEST(SensorOffsetPitch, IsAddedToThePitchAlone) {
  SimulationRequest q = RandomRobotDrop(RobotParametersFor(2), 1, 0.2);
  const std::array rows = {0.1};
  const std::array channels = {Channel::kBodyPitch, Channel::kBodyX, Channel::kLegAngle1};
  q.row_times = rows;
  q.channels = channels;
  const Trajectory straight = Simulate(q);
  const std::array effects = {EffectOf("sensor_offset_pitch", 0.01)};
  q.effects = effects;
  const Trajectory askew = Simulate(q);
  EXPECT_DOUBLE_EQ(askew.samples[0], straight.samples[0] + 0.01);
  EXPECT_EQ(askew.samples[1], straight.samples[1]);
  EXPECT_EQ(askew.samples[2], straight.samples[2]);
}

}  // namespace
}  // namespace hoplab
