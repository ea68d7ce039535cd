// How a hopper falls, by name, and what the rows after a fall hold.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/effect_requests.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

TEST(Fall, ByHeight) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.fall_height = 0.165;  // touch-down is at 0.168 m
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kFellHeight);
  EXPECT_EQ(EventNames(run), "touchdown fall_height");
  EXPECT_NEAR(run.final_state[1], 0.165, kEventResidual);
}

TEST(Fall, AtTouchdownIfThatIsBelowTheLowestHeightAlready) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.fall_height = 0.18;  // touch-down is at 0.168 m
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kFellHeight);
  EXPECT_EQ(EventNames(run), "touchdown");
}

TEST(Fall, ByArcIfTheLegLandsNearItsHip) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.theta_td = std::numbers::pi - 0.15;
  q.parameters.fall_height = 0.0;
  q.initial[2] = 0.0;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kFellArc);
}

TEST(Fall, ByAngle) {
  // Held up by a braking hip, the straight leg tips over slowly.
  SimulationRequest q = SteadyStraightLeg();
  q.parameters.d = 500.0;
  q.parameters.kp = 5000.0;
  q.parameters.v_des = 0.1;
  q.parameters.theta_td = Degrees(-5.0);
  q.parameters.fall_height = 0.01;
  q.initial = {0.0, 1.01, 0.1, 0.0};
  q.horizon = 100.0;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kFellAngle) << EventNames(run);
  const auto& z = run.final_state;
  EXPECT_NEAR(std::atan2(std::abs(z[4] - z[0]), z[1]), Degrees(80.0), 1e-9);
}

TEST(Fall, ByNoReturnAfterALiftoffOnTheWayDown) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.theta_td = Degrees(-10.0);
  q.initial[2] = 1.2;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kFellNoReturn);
  EXPECT_EQ(EventNames(run), "touchdown liftoff fall_height");
  EXPECT_LT(run.final_state[3], 0.0);
  EXPECT_NEAR(run.final_state[1], 0.5 * q.parameters.r, 1e-12);
}

TEST(Fall, HasNotHappenedWhereTheRecordEndsBeforeTheGround) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.theta_td = Degrees(-10.0);
  q.initial[2] = 1.2;
  const Trajectory fall = Simulate(q);
  const double liftoff = fall.events[1].time;
  q.horizon = 0.5 * (liftoff + fall.end_time);
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  EXPECT_EQ(run.final_mode, Mode::kFlight);
}

TEST(Fall, BelowTouchdownHeightIsBallisticAndDifferentiable) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.theta_td = Degrees(-10.0);
  q.initial[2] = 1.2;
  const Trajectory fall = Simulate(q);
  const double liftoff = fall.events[1].time, late = 0.5 * (liftoff + fall.end_time);
  const std::array times = {late};
  const std::array directions = {D::Parameter(ParameterId::kE), D::InitialState(2)};
  q.row_times = times;
  q.channels = kBodyChannels;
  q.directions = directions;
  q.horizon = late + 1e-3;
  const Trajectory run = Simulate(q);
  const double dt = late - liftoff;
  EXPECT_NEAR(run.samples[1],
              fall.events[1].y + fall.events[1].vy_after * dt - 0.5 * q.parameters.g * dt * dt,
              1e-9);
  for (int k = 0; k < 2; ++k) {
    const auto at = [&](double factor) {
      SimulationRequest moved = q;
      moved.directions = {};
      (k == 0 ? moved.parameters.E : moved.initial[2]) *= factor;
      return Simulate(moved).samples[1];
    };
    const double size = k == 0 ? q.parameters.E : q.initial[2], h = 1e-4;
    const double slope =
        (8.0 * (at(1 + h) - at(1 - h)) - at(1 + 2 * h) + at(1 - 2 * h)) / (12.0 * h * size);
    EXPECT_NEAR(run.sensitivities[2 + k] / slope, 1.0, 1e-6) << k;
  }
}

TEST(Fall, IsFollowedByAFreeFlightWhereThatIsAskedFor) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.theta_td = Degrees(-10.0);
  q.initial[2] = 1.2;
  const Trajectory fall = Simulate(q);
  const double dt = 0.2;
  const std::array times = {fall.end_time - 1e-6, fall.end_time + dt};
  const std::array directions = {D::InitialState(2)};
  q.row_times = times;
  q.channels = kBodyChannels;
  q.directions = directions;
  q.fly_on = true;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kFellNoReturn);
  const auto& z = fall.final_state;
  EXPECT_NEAR(run.samples[4], z[0] + z[2] * dt, 1e-9);
  EXPECT_NEAR(run.samples[5], z[1] + z[3] * dt - 0.5 * q.parameters.g * dt * dt, 1e-9);
  const auto at = [&](double vx) {
    SimulationRequest moved = q;
    moved.directions = {};
    moved.initial[2] = vx;
    return Simulate(moved).samples[5];
  };
  const double h = 1e-4;
  const double slope =
      (8.0 * (at(1.2 + h) - at(1.2 - h)) - at(1.2 + 2 * h) + at(1.2 - 2 * h)) / (12.0 * h);
  EXPECT_NEAR(run.sensitivities[5] / slope, 1.0, 1e-6);
}

TEST(Fall, ByNoReturnAtAnApexBelowTouchdownHeight) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.theta_td = Degrees(-10.0);
  q.initial[2] = 0.6;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kFellNoReturn);
  EXPECT_EQ(EventNames(run), "touchdown liftoff apex fall_height");
  EXPECT_EQ(run.hops, 0);
}

TEST(Fall, LeavesLaterRowsMissing) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.theta_td = Degrees(-10.0);
  q.initial[2] = 1.2;
  const double end = Simulate(q).end_time;
  const std::array times = {0.5 * end, end + 0.01, end + 1.0};
  const std::array directions = {D::InitialState(0)};
  q.row_times = times;
  q.channels = kBodyChannels;
  q.directions = directions;
  const Trajectory run = Simulate(q);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(std::isfinite(run.samples[i]));
    EXPECT_TRUE(std::isfinite(run.sensitivities[i]));
  }
  for (int i = 4; i < 12; ++i) {
    EXPECT_TRUE(std::isnan(run.samples[i]));
    EXPECT_TRUE(std::isnan(run.sensitivities[i]));
  }
}

}  // namespace
}  // namespace hoplab
