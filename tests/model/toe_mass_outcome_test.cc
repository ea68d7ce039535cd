#include <gtest/gtest.h>

#include <array>

#include "tests/support/effect_requests.h"
#include "tests/support/matrix_near.h"
#include "tests/support/toe_mass.h"

namespace hoplab {
namespace {

using namespace testing;

SimulationRequest Unplaced(SimulationRequest q) {
  q.parameters.kp_place = q.parameters.kd_place = 0.0;
  return q;
}

TEST(ToeMassOutcome, AStartBelowTouchdownHeightIsRefused) {
  for (const Law law : kLegLaws) {
    SimulationRequest q = ToeMassRequest(law);
    q.initial[1] = 0.05;
    EXPECT_EQ(Simulate(q).outcome, Outcome::kStartsInGround) << NameOf(law);
  }
}

TEST(ToeMassOutcome, ALegThatNothingPlacesFallsInTheAir) {
  const std::pair<Law, Outcome> falls[] = {{Law::kConsistent, Outcome::kFellAngle},
                                           {Law::kLargeDeflection, Outcome::kFellAngle},
                                           {Law::kStraightLeg, Outcome::kFellHeight}};
  for (const auto& [law, fall] : falls) {
    SimulationRequest q = Unplaced(ToeMassRequest(law));
    q.max_hops = 3;
    const Trajectory run = Simulate(q);
    EXPECT_EQ(run.outcome, fall) << NameOf(law) << ' ' << EventNames(run);
    EXPECT_EQ(run.final_mode, Mode::kFlight) << NameOf(law);
  }
}

TEST(ToeMassOutcome, ATouchdownWhileTheChordLengthensIsNoSupport) {
  SimulationRequest q = ToeMassRequest(Law::kStraightLeg);
  q.parameters.theta_td = Degrees(40.0);
  q.initial = {0.0, 0.15, -2.0, -0.1};
  EXPECT_EQ(Simulate(q).outcome, Outcome::kNoSupport);
}

TEST(ToeMassOutcome, AnApexBelowTouchdownHeightIsNoReturn) {
  SimulationRequest q = ToeMassRequest(Law::kLargeDeflection);
  q.parameters.d = 25.0;
  q.max_hops = 5;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kFellNoReturn);
}

TEST(ToeMassOutcome, AVibratingLegThatLandsStretchedIsHeldUntilItPushes) {
  // Undamped: each landing finds the leg at another phase of its vibration.
  SimulationRequest q = ToeMassRequest(Law::kStraightLeg);
  q.parameters.d = 0.0;
  q.parameters.theta_td = 0.0;
  q.initial = {0.0, 0.3, 0.0, 0.0};
  q.max_hops = 12;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kHopLimit) << NameOf(run.outcome);
  int stretched = 0;
  for (int hop = 1; hop <= 12; ++hop) {
    const Trajectory landed = Simulate(EndedAfter(q, EventKind::kTouchdown, -1e-9, hop));
    const auto& z = landed.final_state;
    if (z[1] - z[5] > q.parameters.l0 + 1e-4) ++stretched;
  }
  EXPECT_GT(stretched, 1);
}

TEST(ToeMassOutcome, RowsReadBeforeTheStartLieOnTheParabolaBackwards) {
  SimulationRequest q = ToeMassRequest(Law::kConsistent);
  q.parameters.m_toe = 1e-7;  // stiff: nothing is integrated backwards
  const double delay = 0.02;
  const std::array effects = {Setting("sensor_delay", delay)};
  const std::array times = {0.0};
  const std::array channels = {Channel::kBodyX, Channel::kBodyY};
  q.effects = effects;
  q.row_times = times;
  q.channels = channels;
  q.horizon = 0.001;
  const Trajectory run = Simulate(q);
  const auto& s = q.initial;
  EXPECT_NEAR(run.samples[0], s[0] - s[2] * delay, 1e-14);
  EXPECT_NEAR(run.samples[1], s[1] - s[3] * delay - 0.5 * q.parameters.g * delay * delay, 1e-14);
}

TEST(ToeMassSlope, FlightOverASlopeKeepsHorizontalMomentumInTheWorld) {
  for (const Law law : {Law::kLargeDeflection, Law::kStraightLeg}) {
    SimulationRequest q = ToeMassRequest(law);
    const std::array effects = {Setting("ground_slope", 0.08)};
    q.effects = effects;
    const Trajectory a = Simulate(EndedAfter(q, EventKind::kLiftoff, 0.001));
    const Trajectory b = Simulate(EndedAfter(q, EventKind::kLiftoff, 0.06));
    ASSERT_EQ(b.final_mode, Mode::kFlight);
    const auto& p = q.parameters;
    const auto momentum = [&](const Trajectory& run, int axis) {
      return p.m * run.final_state[2 + axis] + p.m_toe * run.final_state[6 + axis];
    };
    EXPECT_NEAR(momentum(b, 0), momentum(a, 0), 1e-11);
    EXPECT_NEAR(momentum(b, 1) - momentum(a, 1), -(p.m + p.m_toe) * p.g * (b.end_time - a.end_time),
                1e-11);
    // The toe left the ground where the slope is.
    const Trajectory left = Simulate(EndedAfter(q, EventKind::kLiftoff, 1e-9));
    ASSERT_EQ(left.final_mode, Mode::kFlight);
    if (law == Law::kStraightLeg) {
      EXPECT_NEAR(left.final_state[5], std::tan(0.08) * left.final_state[4], 1e-12);
    }
  }
}

TEST(ToeMassSlope, EnergyOfAHopOnTheToeIsLostAtTouchdownAlone) {
  SimulationRequest q = Unplaced(ToeMassRequest(Law::kStraightLeg));
  q.parameters.d = 0.0;
  const std::array effects = {Setting("ground_slope", 0.05)};
  q.effects = effects;
  const Trajectory before = Simulate(EndedAfter(q, EventKind::kTouchdown, -1e-12));
  const Trajectory after = Simulate(EndedAfter(q, EventKind::kLiftoff, 0.02));
  ASSERT_EQ(after.final_mode, Mode::kFlight);
  const double speed = std::hypot(before.final_state[6], before.final_state[7]);
  EXPECT_NEAR(Energy(q, Mode::kFlight, q.initial) - Energy(q, Mode::kFlight, after.final_state),
              0.5 * q.parameters.m_toe * speed * speed, 1e-10);
}

TEST(ToeMassEnergy, OfAStateWithoutItsToeIsThatOfARelaxedLegMovingWithTheHip) {
  const SimulationRequest q = ToeMassRequest(Law::kStraightLeg);
  const auto& p = q.parameters;
  const auto& s = q.initial;
  const double v2 = s[2] * s[2] + s[3] * s[3];
  const double toe_height = s[1] - p.l0 * std::cos(p.theta_td);
  EXPECT_NEAR(Energy(q, Mode::kFlight, s),
              0.5 * (p.m + p.m_toe) * v2 + p.g * (p.m * s[1] + p.m_toe * toe_height), 1e-13);
}

}  // namespace
}  // namespace hoplab
