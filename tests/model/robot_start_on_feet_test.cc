#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// A robot whose run begins on feet that stand ahead of straight below their legs, M119.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// Motors locked, feet that hold: what a moment of its run is told by.
Parameters<double> LockedRobot(int legs) {
  Parameters<double> p = RobotParametersFor(legs);
  p.robot->control = MotorControl::kLocked;
  p.robot->damping = 4e-4;
  p.robot->starts_leaning = true;
  return p;
}

// How far the foot of a leg is ahead of where it had landed straight below, by M79 alone.
double AheadOf(const Trajectory& run, const Parameters<double>& p, int leg) {
  const std::vector<double>& z = run.final_state;
  const auto at = static_cast<std::size_t>(leg);
  const RobotParameters<double>& robot = *p.robot;
  const double pitch = z[4], beta = pitch + z[6 + at];
  const double contact = z[6 + 2 * static_cast<std::size_t>(robot.legs) + at];
  const double hip = z[0] + robot.hip_x[at] * std::cos(pitch) - robot.hip_y[at] * std::sin(pitch);
  if (beta <= 0.0) return contact - (hip + 2.0 * p.r * std::sin(beta));
  return contact - (hip + p.r * std::sin(beta) - p.r * (std::numbers::pi - beta));
}

// The run up to that moment, and what it begins with if it begins there.
struct Moment {
  Trajectory run;
  std::vector<double> start;
  int standing = 0;
  double farthest = 0.0;  // a foot, ahead or behind [m]
  bool as_landed = true;  // each leg stands on the part of it that would land (M79)
};
Moment MomentOf(SimulationRequest q, double time) {
  Moment m;
  q.horizon = time;
  m.run = Simulate(q);
  m.start.assign(m.run.final_state.begin(), m.run.final_state.begin() + 6);
  for (int leg = 0; leg < q.parameters.robot->legs; ++leg) {
    const Foot& foot = m.run.final_feet[static_cast<std::size_t>(leg)];
    const bool stands = foot.stance != Foot::Stance::kFlight;
    m.start.push_back(stands ? AheadOf(m.run, q.parameters, leg) : 0.0);
    m.standing += stands ? 1 : 0;
    const bool behind =
        m.run.final_state[4] + m.run.final_state[6 + static_cast<std::size_t>(leg)] <= 0.0;
    if (stands) m.as_landed = m.as_landed && (foot.stance == Foot::Stance::kToe) == behind;
    m.farthest = std::max(m.farthest, std::abs(m.start.back()));
  }
  for (int leg = 0; leg < q.parameters.robot->legs; ++leg) {
    const auto at = static_cast<std::size_t>(leg);
    m.start.push_back(m.run.final_state[6 + at] - q.parameters.robot->angle[at]);
  }
  return m;
}

TEST(StartOnFeet, GoesOnAsTheRunItIsAMomentOf) {
  int standing = 0;
  double farthest = 0.0, without = 0.0;
  for (const int legs : {1, 2, 3}) {
    const int before = standing;
    for (const unsigned seed : {1u, 2u, 5u}) {
      SimulationRequest q = RandomRobotDrop(LockedRobot(legs), seed, 0.0);
      const double whole = 0.16;
      for (const double time : {0.09, 0.11, 0.13}) {
        const Moment moment = MomentOf(q, time);
        if (moment.run.outcome != Outcome::kCompleted || moment.standing == 0 || !moment.as_landed)
          continue;
        standing += moment.standing;
        farthest = std::max(farthest, moment.farthest);
        const Trajectory run = MomentOf(q, whole).run;
        SimulationRequest later = q;
        later.horizon = whole - time;
        later.initial = moment.start;
        const Trajectory resumed = Simulate(later);
        ASSERT_EQ(resumed.outcome, run.outcome);
        for (std::size_t k = 0; k < run.final_state.size(); ++k)
          EXPECT_NEAR(resumed.final_state[k], run.final_state[k], 2e-8)
              << legs << " legs, seed " << seed << ", " << time << " s: " << k;
        later.initial.resize(6);
        without = std::max(without, std::abs(Simulate(later).final_state[2] - run.final_state[2]));
      }
    }
    EXPECT_TRUE(legs == 1 || standing > before) << legs;
  }
  EXPECT_GE(standing, 6);
  EXPECT_GT(farthest, 2e-3);
  EXPECT_GT(without, 0.02) << "straight below is as good";  // m/s
}

TEST(StartOnFeet, HasTheDerivativesOfDifferences) {
  for (const int legs : {2, 3}) {
    SimulationRequest q = RandomRobotDrop(LockedRobot(legs), legs == 2 ? 1 : 2, 0.0);
    const Moment moment = MomentOf(q, 0.11);
    ASSERT_GT(moment.standing, 0);
    q.parameters.robot->control = MotorControl::kHeld;
    q.initial = moment.start;
    q.horizon = 0.05;
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    std::vector<D> directions = {D::InitialState(1), D::Parameter(ParameterId::kE)};
    for (int leg = 0; leg < legs; ++leg) {
      directions.push_back(D::InitialState(6 + leg));
      directions.push_back(D::InitialState(6 + legs + leg));
    }
    EXPECT_GE(ExpectRobotExact(q, {}, directions), 5) << legs;
  }
}

// A leg in the air has no foot that could be ahead.
TEST(StartOnFeet, MeansNothingInTheAir) {
  SimulationRequest q = RandomRobotDrop(LockedRobot(2), 1, 0.3);
  const Trajectory plain = Simulate(q);
  q.initial.resize(8, 0.004);
  q.initial.resize(10, 0.0);
  const Trajectory told = Simulate(q);
  EXPECT_GT(plain.events.size(), 1u);
  EXPECT_EQ(told.final_state, plain.final_state);
}

}  // namespace
}  // namespace hoplab
