#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_energy.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// Ground that gives way under a robot's feet, M28.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// Undamped, on ice, with locked motors nothing is lost, not even where a foot lands or leaves; legs
// without mass, since one with mass stops with a blow.
TEST(RobotOnSoftGround, KeepsItsEnergyOnIce) {
  double worst = 0.0;
  int events = 0;
  for (int legs : {2, 3}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Parameters<double> p = RobotParametersFor(legs);
      p.robot->control = MotorControl::kLocked;
      p.robot->friction = 0.0;
      p.robot->clamp = legs == 3 ? 0.006 : 0.0;
      p.robot->ground_compliance = 5e-5;
      const EnergyRun at = RunWithEnergy(RandomRobotDrop(p, seed, 1.0));
      for (double e : at.energy) worst = std::max(worst, std::abs(e - at.energy.front()));
      events += static_cast<int>(at.run.events.size());
    }
  }
  std::printf("energy on ice that gives way, worst drift: %.1e J of 7 over %d events\n", worst,
              events);
  EXPECT_LT(worst, 7e-9);
  EXPECT_GT(events, 80);
}

// Held feet, with and without mass: between events the energy stays.
TEST(RobotOnSoftGround, KeepsItsEnergyBetweenEvents) {
  for (const double leg_mass : {0.0, 0.02}) {
    double worst = 0.0;
    int steps = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
      Parameters<double> p = RobotParametersFor(2);
      p.robot->control = MotorControl::kLocked;
      p.robot->leg_mass = leg_mass;
      p.robot->ground_compliance = 5e-5;
      const EnergyRun at = RunWithEnergy(RandomRobotDrop(p, seed, 0.5));
      std::size_t next = 0;
      for (std::size_t i = 1; i < at.energy.size(); ++i) {
        bool calm = true;
        for (; next < at.run.events.size() && at.run.events[next].time < at.times[i]; ++next)
          calm = false;
        if (!calm) continue;
        worst = std::max(worst, std::abs(at.energy[i] - at.energy[i - 1]));
        ++steps;
      }
    }
    std::printf("legs of %g kg: worst change in 1 ms %.1e J, %d ms\n", leg_mass, worst, steps);
    EXPECT_LT(worst, 1e-9);
    EXPECT_GT(steps, 800);
  }
}

// At rest on ice a robot stands lower by what the ground yields to its weight, on every foot its
// share.
TEST(RobotOnSoftGround, SinksByItsWeight) {
  for (int legs : {1, 3}) {
    const auto stand = [&](double compliance) {
      Parameters<double> p = RobotParametersFor(legs);
      p.robot->control = MotorControl::kLocked;
      p.robot->friction = 0.0;
      p.robot->damping = 2e-2;
      p.robot->pitch_inertia = 1e14;
      p.robot->ground_compliance = compliance;
      SimulationRequest q = RobotDrop(p, {0.0, 0.17, 0.0, 0.0, 0.0, 0.0}, 2.0);
      const std::array rows = {1.999};
      const std::array channels = {Channel::kBodyY, Channel::kBodyVy, Channel::kLegContactY1};
      q.row_times = rows;
      q.channels = channels;
      const Trajectory run = Simulate(q);
      EXPECT_EQ(run.outcome, Outcome::kCompleted);
      return run.samples;
    };
    const double compliance = 5e-5, weight = 3.0 * 9.81;
    const std::vector<double> hard = stand(0.0), soft = stand(compliance);
    EXPECT_NEAR(soft[1], 0.0, 1e-8);
    EXPECT_NEAR(hard[0] - soft[0], compliance * weight / legs, 1e-9);
    EXPECT_NEAR(soft[2], -compliance * weight / legs, 1e-9);
    EXPECT_EQ(hard[2], 0.0);
    EXPECT_FALSE(std::signbit(hard[2]));
  }
}

// From hard ground on, and on soft; feet that roll, hold and slide, with mass and without.
TEST(RobotOnSoftGround, HasTheDerivativesOfDifferences) {
  for (const double leg_mass : {0.0, 0.01}) {
    for (const double size : {0.0, 3e-5}) {
      for (const double friction : {0.3, 0.9}) {
        Parameters<double> p = RobotParametersFor(2);
        p.robot->friction = friction;
        p.robot->damping = 3e-4;
        p.robot->leg_mass = leg_mass;
        p.robot->rotor_inertia = 4e-3;
        std::array effects = {EffectSetting::Null(*FindEffect("ground_compliance"))};
        effects[0].values[0] = size;
        SimulationRequest q = RandomRobotDrop(p, 2, 0.2);
        q.effects = effects;
        q.integrator.relative_tolerance = kOracleRelative;
        q.integrator.absolute_tolerance = 1e-2 * kOracleAbsolute;
        EXPECT_GE(ExpectRobotExact(q, {},
                                   {D::EffectParameter(0, 0), D::Parameter(ParameterId::kE),
                                    D::Parameter(ParameterId::kFriction), D::InitialState(2)}),
                  10)
            << leg_mass << ", " << size << ", " << friction;
      }
    }
  }
}

}  // namespace
}  // namespace hoplab
