#include <gtest/gtest.h>

#include <array>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// Hips of a robot that sit further apart than was stated, M106.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

TEST(HipSpacing, IsARobotThatIsStatedSo) {
  const double gain = 0.07;
  for (const int legs : {2, 3}) {
    Parameters<double> p = RobotParametersFor(legs);
    p.robot->friction = 0.9;
    p.robot->damping = 3e-4;
    p.robot->leg_mass = 0.01;
    p.robot->hip_x[1] += 0.013;  // not even about the origin
    SimulationRequest q = RandomRobotDrop(p, 3, 0.3);
    const std::array effects = {EffectOf("hip_spacing", gain)};
    q.effects = effects;
    const Trajectory spaced = Simulate(q);
    q.effects = {};
    double mean = 0.0;
    for (int i = 0; i < legs; ++i) mean += p.robot->hip_x[i] / legs;
    for (int i = 0; i < legs; ++i)
      q.parameters.robot->hip_x[i] = mean + (1.0 + gain) * (p.robot->hip_x[i] - mean);
    const Trajectory stated = Simulate(q);
    ASSERT_EQ(spaced.outcome, stated.outcome);
    ASSERT_EQ(spaced.final_state.size(), stated.final_state.size());
    EXPECT_GT(spaced.events.size(), 1u);
    for (std::size_t k = 0; k < stated.final_state.size(); ++k)
      EXPECT_NEAR(spaced.final_state[k], stated.final_state[k], 1e-12) << k;
  }
}

TEST(HipSpacing, HasTheDerivativesOfDifferences) {
  for (const double gain : {0.0, 0.05}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.9;
    p.robot->damping = 3e-4;
    p.robot->rotor_inertia = 4e-3;
    const std::array effects = {EffectOf("hip_spacing", gain)};
    SimulationRequest q = RandomRobotDrop(p, 2, 0.2);
    q.effects = effects;
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    EXPECT_GE(ExpectRobotExact(q, {}, {D::EffectParameter(0, 0), D::InitialState(1)}), 4) << gain;
  }
}

TEST(HipSpacing, MeansNothingOnOneLeg) {
  const Effect& effect = *FindEffect("hip_spacing");
  EXPECT_FALSE(AppliesTo(effect, Law::kRobot, LegMass::kNone, kEveryInput, RobotLegs(1)));
  EXPECT_TRUE(AppliesTo(effect, Law::kRobot, LegMass::kNone, kEveryInput, RobotLegs(2)));
}

}  // namespace
}  // namespace hoplab
