#include <gtest/gtest.h>

#include <array>

#include "tests/support/effect_requests.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// ---- initial states
// ------------------------------------------------------------------------------

TEST(Start, BelowTouchdownHeightIsRefused) {
  for (Law law : {Law::kThesis, Law::kLargeDeflection, Law::kStraightLeg, Law::kBall}) {
    SimulationRequest q = law == Law::kBall          ? BallRequest()
                          : law == Law::kStraightLeg ? SteadyStraightLeg()
                                                     : ThickLegRequest(law);
    q.initial[1] = 0.01;
    const Trajectory run = Simulate(q);
    EXPECT_EQ(run.outcome, Outcome::kStartsInGround) << NameOf(law);
    EXPECT_TRUE(run.events.empty());
  }
}

TEST(Start, AtTouchdownHeightAndFallingTouchesDownAtOnce) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.initial[1] = q.parameters.r * (1.0 + std::cos(q.parameters.theta_td));
  q.initial[3] = -1.0;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kHopLimit);
  EXPECT_EQ(run.events[0].kind, EventKind::kTouchdown);
  EXPECT_EQ(run.events[0].time, 0.0);
}

TEST(Start, ZeroLengthHorizonGivesTheStart) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.horizon = 0.0;
  const std::array times = {0.0};
  const std::array directions = {D::InitialState(1), D::Parameter(ParameterId::kE)};
  q.row_times = times;
  q.channels = kBodyChannels;
  q.directions = directions;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  EXPECT_EQ(run.end_time, 0.0);
  for (int c = 0; c < 4; ++c) {
    EXPECT_EQ(run.samples[c], q.initial[c]);
    EXPECT_EQ(run.sensitivities[c * 2], c == 1 ? 1.0 : 0.0);
    EXPECT_EQ(run.sensitivities[c * 2 + 1], 0.0);
  }
}

TEST(Start, AnApexDoesNotCountAsAHop) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.initial[3] = 0.5;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(EventNames(run), "apex touchdown liftoff apex");
  EXPECT_EQ(run.hops, 1);
}

// ---- grazing and missing -----------------------------------------------------------------

TEST(Grazing, TouchdownWithoutSpeedEndsTheRun) {
  for (Law law : {Law::kLargeDeflection, Law::kStraightLeg}) {
    SimulationRequest q = law == Law::kStraightLeg ? SteadyStraightLeg() : ThickLegRequest(law);
    const auto& p = q.parameters;
    q.initial[1] =
        law == Law::kStraightLeg ? p.l0 * std::cos(p.theta_td) : p.r * (1.0 + std::cos(p.theta_td));
    q.initial[3] = 0.0;
    EXPECT_EQ(Simulate(q).outcome, Outcome::kGrazing) << NameOf(law);
  }
}

TEST(Grazing, TouchdownAtLowSpeedIsReportedByItsCrossingRate) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const double height = q.parameters.r * (1.0 + std::cos(q.parameters.theta_td));
  q.initial[1] = height + 1e-6;
  q.initial[3] = 0.0;
  const Trajectory run = Simulate(q);
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events[0].kind, EventKind::kTouchdown);
  const double speed = std::sqrt(2.0 * q.parameters.g * 1e-6);
  EXPECT_NEAR(run.events[0].crossing_rate / (-speed / q.parameters.r), 1.0, 1e-6);
  EXPECT_LE(run.least_crossing_rate, std::abs(run.events[0].crossing_rate));
}

TEST(Gravity, OfZeroLeavesTheBodyFlying) {
  for (Law law : {Law::kLargeDeflection, Law::kStraightLeg, Law::kBall}) {
    SimulationRequest q = law == Law::kBall          ? BallRequest()
                          : law == Law::kStraightLeg ? SteadyStraightLeg()
                                                     : ThickLegRequest(law);
    q.parameters.g = 0.0;
    q.initial[3] = 0.2;
    q.horizon = 2.0;
    const Trajectory run = Simulate(q);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << NameOf(law);
    EXPECT_NEAR(run.final_state[1], q.initial[1] + 0.4, 1e-14);
  }
}

TEST(Gravity, OfZeroStillLetsAFallingBodyTouchDown) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.g = 0.0;
  q.initial[3] = -1.0;
  q.horizon = 1.0;
  const Trajectory run = Simulate(q);
  ASSERT_GE(run.events.size(), 2u);
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  const double height = q.parameters.r * (1.0 + std::cos(q.parameters.theta_td));
  EXPECT_NEAR(run.events[0].time, q.initial[1] - height, 1e-14);
}

// ---- ends --------------------------------------------------------------------------------

TEST(Horizon, MayEndInsideAStance) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const Trajectory hop = Simulate(q);
  q.horizon = 0.5 * (hop.events[0].time + hop.events[1].time);
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  EXPECT_EQ(run.final_mode, Mode::kRolling);
  EXPECT_EQ(run.end_time, q.horizon);
  EXPECT_EQ(run.hops, 0);
}

TEST(Horizon, MayPassWhileTheLegNeverLeavesTheGround) {
  SimulationRequest q = SteadyStraightLeg();
  q.parameters.theta_td = 0.0;
  q.parameters.d = 2000.0;  // overdamped
  q.initial = {0.0, 1.0 + 1e-3, 0.0, 0.0};
  q.horizon = 30.0;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  EXPECT_EQ(run.final_mode, Mode::kStance);
  // It settles where k (l0 - y) = m g.
  EXPECT_NEAR(run.final_state[1], 1.0 - 100.0 * 10.0 / 1e4, 1e-9);
}

TEST(NoSupport, ATouchdownThatLengthensTheChordEndsTheRun) {
  // (Not under `no_slip`: its contact runs away from the hip faster than the chord lengthens.)
  for (Law law : {Law::kThesis, Law::kConsistent, Law::kLargeDeflection, Law::kStraightLeg}) {
    SimulationRequest q = law == Law::kStraightLeg ? SteadyStraightLeg() : ThickLegRequest(law);
    q.parameters.theta_td = Degrees(45.0);
    q.initial[1] *= 1.2;
    q.initial[2] = -8.0;  // backward faster than it falls
    const Trajectory run = Simulate(q);
    EXPECT_EQ(run.outcome, Outcome::kNoSupport) << NameOf(law);
    EXPECT_EQ(EventNames(run), "touchdown") << NameOf(law);
  }
}

TEST(NoSupport, OfADampedLegIsNoSupportToo) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.d = 20.0;
  q.parameters.theta_td = Degrees(45.0);
  q.initial[2] = -8.0;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kNoSupport);
}

TEST(EventLimit, EndsARunWithMoreEventsThanAnyTraceHas) {
  SimulationRequest q = BallRequest();
  q.parameters.restitution = 1.0;
  q.initial = {0.0, 0.051, 0.0, 0.0};
  q.horizon = 1e4;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kEventLimit);
}

TEST(HopLimit, EndsTheRunAtTheApexAfterTheLastHop) {
  for (int hops : {1, 2, 3}) {
    SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
    q.parameters.theta_td = Degrees(24.0);
    q.max_hops = hops;
    const Trajectory run = Simulate(q);
    EXPECT_EQ(run.outcome, Outcome::kHopLimit);
    EXPECT_EQ(run.hops, hops);
    EXPECT_EQ(run.events.back().kind, EventKind::kApex);
    EXPECT_NEAR(run.final_state[3], 0.0, kEventResidual);
  }
}

TEST(LiftoffRule, RestLengthEndsTheStanceWhereTheChordIsUnloaded) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const double by_force = Simulate(q).events[1].time;
  q.liftoff = LiftoffRule::kRestLength;
  const Trajectory hop = Simulate(q);
  ASSERT_EQ(hop.events[1].kind, EventKind::kLiftoff);
  EXPECT_GT(hop.events[1].time, by_force);  // the damper pulls for a while
  q.horizon = hop.events[1].time - 1e-12;
  const std::array times = {q.horizon};
  const std::array channels = {Channel::kLegLength, Channel::kLegAngle};
  q.row_times = times;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  EXPECT_NEAR(run.samples[0], 2.0 * q.parameters.r * std::cos(0.5 * run.samples[1]), 1e-11);
}

// Sensitivities of more directions than one pass holds are found by several. A sharp effect steers
// the steps of its own pass alone.
TEST(StepLimit, InALaterPassOfTheSensitivitiesIsTheOutcomeOfTheRun) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const EffectSetting gravity = EffectSetting::Null(*FindEffect("gravity_scale"));
  const EffectSetting friction = EffectSetting::Null(*FindEffect("guide_coulomb_friction"));
  const std::array effects = {gravity, friction};
  q.effects = effects;
  std::vector<D> directions;
  for (int i = 0; i < 4; ++i) directions.push_back(D::InitialState(i));
  for (ParameterId id : {ParameterId::kE, ParameterId::kD, ParameterId::kG, ParameterId::kM})
    directions.push_back(D::Parameter(id));
  directions.push_back(D::EffectParameter(0, 0));
  q.directions = directions;
  const std::vector<double> times = EvenTimes(0.9 * Simulate(q).end_time, 10);
  q.row_times = times;
  q.channels = kBodyChannels;
  const Trajectory smooth = Simulate(q);
  ASSERT_EQ(smooth.outcome, Outcome::kHopLimit);
  q.integrator.max_steps = smooth.steps + 1;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kHopLimit);
  directions.back() = D::EffectParameter(1, 0);
  q.directions = directions;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kStepLimit);
  q.integrator.max_steps = 100 * smooth.steps;
  const Trajectory patient = Simulate(q);
  EXPECT_EQ(patient.outcome, Outcome::kHopLimit);
  ASSERT_EQ(patient.sensitivities.size(), 10u * 4u * 9u);
  for (double value : patient.sensitivities) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace hoplab
