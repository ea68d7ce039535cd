#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_energy.h"
#include "tests/support/robot_requests.h"
#include "tests/support/robot_rods.h"
#include "tests/support/tolerances.h"

// What a robot is held and guided by: a boom whose mass moves with its body, a guide that rubs.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

EffectSetting Boom(double along, double up) {
  EffectSetting boom = EffectOf("boom_inertia", along);
  boom.values[1] = up;
  return boom;
}

SimulationRequest Precisely(SimulationRequest q) {
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  return q;
}

// A boom of the same mass either way is a heavier body, and a force that carries what it weighs
// more: in the air, through blows, on feet that slide, with and without a mass of the legs.
TEST(RobotBoom, IsAHeavierBodyThatIsCarried) {
  int events = 0;
  for (const double leg_mass : {0.0, 1e-4, 0.02}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      Parameters<double> p = RobotParametersFor(2);
      p.robot->com_x = 0.02;
      p.robot->com_y = -0.01;
      p.robot->friction = 0.9;
      p.robot->leg_mass = leg_mass;
      SimulationRequest q = Precisely(RandomRobotDrop(p, seed, 0.3));
      const std::array boom = {Boom(0.25, 0.25)};
      q.effects = boom;
      const Trajectory held = Simulate(q);
      const std::array times = {-1.0, 1.0};
      const std::array values = {0.25 * p.m * p.g, 0.25 * p.m * p.g};
      const std::array carried = {
          DrivenInput{.kind = InputKind::kBodyForceY, .times = times, .values = values}};
      q.effects = {};
      q.inputs = carried;
      q.parameters.m *= 1.25;
      const Trajectory heavier = Simulate(q);
      ASSERT_EQ(held.outcome, Outcome::kCompleted);
      ASSERT_EQ(held.events.size(), heavier.events.size());
      for (std::size_t k = 0; k < held.final_state.size(); ++k)
        EXPECT_NEAR(held.final_state[k], heavier.final_state[k], 1e-8)
            << k << ", seed " << seed << ", legs of " << leg_mass;
      events += static_cast<int>(held.events.size());
    }
  }
  EXPECT_GT(events, 40);
}

// Body and legs fall together by what all of them weigh over all that moves.
TEST(RobotBoom, SlowsAFallOfBodyAndLegs) {
  Parameters<double> p = RodParametersFor(2);
  p.robot->control = MotorControl::kLocked;
  p.robot->angle = {};
  const double t = 0.2;
  for (const double leg_mass : {0.0, 0.2}) {
    p.robot->leg_mass = leg_mass;
    SimulationRequest q = Precisely(RobotDrop(p, {0.0, 2.0, 0.4, 1.0, 0.0, 0.0}, t));
    const std::array boom = {Boom(0.3, 0.5)};
    q.effects = boom;
    const Trajectory run = Simulate(q);
    const double falls = p.g * (p.m + 2.0 * leg_mass) / (1.5 * p.m + 2.0 * leg_mass);
    EXPECT_NEAR(run.final_state[0], 0.4 * t, 1e-10);
    EXPECT_NEAR(run.final_state[1], 2.0 + t - 0.5 * falls * t * t, 1e-10);
    EXPECT_NEAR(run.final_state[4], 0.0, 1e-10);
  }
}

// So does what is told of rows after the end of a run, from where it broke off in the air.
TEST(RobotBoom, SlowsTheFlightAfterARun) {
  Parameters<double> p = RodParametersFor(2);
  p.robot->control = MotorControl::kLocked;
  p.robot->angle = {};
  p.robot->leg_mass = 0.2;
  p.fall_height = 1.9;
  SimulationRequest q = Precisely(RobotDrop(p, {0.0, 2.0, 0.4, 0.0, 0.0, 0.0}, 1.0));
  const std::array boom = {Boom(0.3, 0.5)};
  const std::array times = {0.4};
  const std::array channels = {Channel::kBodyX, Channel::kBodyY};
  q.effects = boom;
  q.row_times = times;
  q.channels = channels;
  q.fly_on = true;
  const Trajectory run = Simulate(q);
  ASSERT_NE(run.outcome, Outcome::kCompleted);
  EXPECT_LT(run.end_time, 0.3);
  const double falls = p.g * (p.m + 0.4) / (1.5 * p.m + 0.4);
  EXPECT_NEAR(run.samples[0], 0.4 * 0.4, 1e-9);
  EXPECT_NEAR(run.samples[1], 2.0 - 0.5 * falls * 0.4 * 0.4, 1e-9);
}

// Mass that differs along and up keeps the energy between events that take some.
TEST(RobotBoom, KeepsTheEnergy) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->control = MotorControl::kLocked;
  p.robot->com_x = 0.03;
  p.robot->com_y = 0.02;
  p.inertia_x = 0.7;
  p.inertia_y = 0.2;
  int compared = 0;
  double most_turn = 0.0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    for (const double leg_mass : {0.0, 0.02}) {
      p.robot->leg_mass = leg_mass;
      const EnergyRun at = RunWithEnergy(Precisely(RandomRobotDrop(p, seed, 0.4)));
      most_turn = std::max(most_turn, std::abs(at.run.final_state[5]));
      for (std::size_t i = 0; i + 1 < at.energy.size(); ++i) {
        bool clear = at.times[i + 1] < at.run.end_time;
        for (const Event& e : at.run.events)
          clear = clear && (e.time < at.times[i] || e.time > at.times[i + 1]);
        if (!clear) continue;
        EXPECT_NEAR(at.energy[i], at.energy[i + 1], 1e-9 * at.energy[0]);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(most_turn, 0.5);
}

// The centre of mass of a robot that turns in the air falls in a guide's grease as a point does.
TEST(RobotGuide, SlowsTheCentreOfMass) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->control = MotorControl::kLocked;
  p.robot->com_x = 0.05;
  const double rate = 2.0, vy = -1.0, t = 0.2, b = 4.0, y = 3.0;
  SimulationRequest q = Precisely(RobotDrop(p, {0.0, y, 0.4, vy, 0.0, rate}, t));
  const double begins = vy + rate * 0.05, settles = p.m / b;
  const auto end = [&](const EffectSetting& effect) {
    const std::array effects = {effect};
    q.effects = effects;
    const Trajectory run = Simulate(q);
    EXPECT_NEAR(run.final_state[4], rate * t, 1e-12);
    EXPECT_NEAR(run.final_state[5], rate, 1e-12);
    return std::array{run.final_state[1] + 0.05 * std::sin(rate * t),
                      run.final_state[3] + rate * 0.05 * std::cos(rate * t)};
  };
  const auto [greased_y, greased_vy] = end(EffectOf("guide_viscous_friction", b));
  const double far = -p.g * settles, left = std::exp(-t / settles);
  EXPECT_NEAR(greased_vy, far + (begins - far) * left, 1e-10);
  EXPECT_NEAR(greased_y, y + far * t + (begins - far) * settles * (1.0 - left), 1e-10);
  // tanh is 1 at fifty times its width.
  const auto [rubbed_y, rubbed_vy] = end(EffectOf("guide_coulomb_friction", 6.0));
  const double falls = p.g - 6.0 / p.m;
  EXPECT_NEAR(rubbed_vy, begins - falls * t, 1e-10);
  EXPECT_NEAR(rubbed_y, y + begins * t - 0.5 * falls * t * t, 1e-10);
}

// On legs with mass, whose equations of motion differ.
TEST(RobotBoom, HasTheDerivativesOfDifferencesOnLegsWithMass) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->friction = 0.9;
  p.robot->damping = 3e-4;
  p.robot->rotor_inertia = 4e-3;
  p.robot->com_x = 0.02;
  for (const double leg_mass : {0.0, 0.01}) {
    for (const double size : {0.0, 0.2}) {
      p.robot->leg_mass = leg_mass;
      const std::array effects = {Boom(size, 0.5 * size), EffectOf("guide_viscous_friction", 1.0)};
      SimulationRequest q = Precisely(RandomRobotDrop(p, 2, 0.2));
      // Errors of a leg's own rate count by what they move the leg (ErrorUnit).
      if (leg_mass > 0.0) q.integrator.absolute_tolerance *= 1e-2;
      q.effects = effects;
      EXPECT_GE(ExpectRobotExact(
                    q, {},
                    {D::EffectParameter(0, 0), D::EffectParameter(0, 1), D::EffectParameter(1, 0),
                     D::Parameter(ParameterId::kM), D::Parameter(ParameterId::kLegMass)}),
                6)
          << leg_mass << ", " << size;
    }
  }
}

}  // namespace
}  // namespace hoplab
