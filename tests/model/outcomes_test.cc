#include <gtest/gtest.h>

#include <array>

#include "model/hybrid/engine.h"
#include "model/integrators/dop853.h"
#include "tests/support/clocks.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

constexpr std::array kBody = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx, Channel::kBodyVy};

// ---- systems made for the purpose --------------------------------------------------------

struct NoRows {
  template <class... Args>
  void operator()(Args&&...) const {}
};
template <template <class> class System>
Trajectory RunSystem(double z0, double z1, double horizon, const System<double>& system = {}) {
  const RunSettings settings{.horizon = horizon, .max_hops = 0, .row_times = {}, .channels = {}};
  NoRows sink;
  Trajectory out;
  Engine<System, double, Dop853, NoRows> engine(system, system, {}, {}, settings, sink, out);
  const double z[2] = {z0, z1};
  engine.Run(Mode::kRolling, z, [](int) { return 0.0; });
  return out;
}

TEST(SimultaneousEvents, AreFlaggedAndFireInTheOrderOfTheGuards) {
  const Trajectory run = RunSystem<TwoClocks>(1.0, 1.0, 2.0);
  ASSERT_EQ(EventNames(run), "rolling_to_toe liftoff");
  EXPECT_TRUE(run.has_simultaneous_events);
  EXPECT_TRUE(run.events[0].simultaneous);
  EXPECT_NEAR(run.events[0].time, 1.0, 1e-15);
  EXPECT_EQ(run.events[1].time, run.events[0].time);
}

TEST(SimultaneousEvents, AreNotFlaggedWhenTheyAreApart) {
  const Trajectory run = RunSystem<TwoClocks>(1.0, 1.00001, 2.0);
  ASSERT_EQ(EventNames(run), "rolling_to_toe liftoff");
  EXPECT_FALSE(run.has_simultaneous_events);
}

TEST(SimultaneousEvents, OfTwoInOneStepTheEarlierFires) {
  const Trajectory run = RunSystem<TwoClocks>(1.01, 1.0, 2.0);
  EXPECT_EQ(EventNames(run), "liftoff");
}

TEST(Chattering, TwoEventsThatUndoEachOtherEndTheRun) {
  const Trajectory run = RunSystem<BackAndForth>(1.0, 0.0, 2.0);
  EXPECT_EQ(run.outcome, Outcome::kChattering);
  EXPECT_NEAR(run.end_time, 1.0, 1e-12);
}

TEST(ClosedGuard, OfLiftoffAfterAChangeOfStanceFiresWithTheChange) {
  using T = Jet<kNarrowJet>;
  LosesSupport<T> system;
  system.rate = Seeded<T>(1.0, 0, 1.0);
  const RunSettings settings{.horizon = 2.0, .max_hops = 0, .row_times = {}, .channels = {}};
  NoRows sink;
  Trajectory out;
  Engine<LosesSupport, T, Dop853, NoRows> engine(system, {}, {}, {}, settings, sink, out);
  const T z[2] = {T(1.0), T(0.5)};
  engine.Run(Mode::kRolling, z, [](int) { return T(0.0); });
  ASSERT_EQ(EventNames(out), "rolling_to_toe liftoff");
  EXPECT_EQ(out.events[1].time, out.events[0].time);
  EXPECT_EQ(out.final_mode, Mode::kFlight);
  // t_e = 1/rate, for both.
  EXPECT_NEAR(engine.event_times()[0], -1.0, 1e-12);
  EXPECT_NEAR(engine.event_times()[kNarrowJet], -1.0, 1e-12);
}

TEST(GuardDip, InsideOneStepIsFound) {
  Dip<double> system;
  system.depth = 1e-4;  // below zero for 0.02 s of a 2 s step
  RunSettings settings{.horizon = 2.0, .max_hops = 0, .row_times = {}, .channels = {}};
  NoRows sink;
  Trajectory out;
  Dip<Jet<1>> rate;
  rate.depth = system.depth;
  Engine<Dip, double, Dop853, NoRows> engine(system, system, rate, {}, settings, sink, out);
  const double z[2] = {0.0, 0.0};
  engine.Run(Mode::kRolling, z, [](int) { return 0.0; });
  ASSERT_EQ(out.events.size(), 1u);
  EXPECT_NEAR(out.events[0].time, 1.0 - 0.01, 1e-12);
}

TEST(GuardDip, ThatStaysAboveZeroIsReportedAsANearMiss) {
  Dip<double> system;
  system.depth = -1e-4;
  RunSettings settings{.horizon = 2.0, .max_hops = 0, .row_times = {}, .channels = {}};
  NoRows sink;
  Trajectory out;
  Dip<Jet<1>> rate;
  rate.depth = system.depth;
  Engine<Dip, double, Dop853, NoRows> engine(system, system, rate, {}, settings, sink, out);
  const double z[2] = {0.0, 0.0};
  engine.Run(Mode::kRolling, z, [](int) { return 0.0; });
  EXPECT_TRUE(out.events.empty());
  EXPECT_NEAR(out.nearest_miss, 1e-4, 1e-8);
}

// ---- starts ------------------------------------------------------------------------------

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
  q.channels = kBody;
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
  EXPECT_EQ(EventNames(run), "touchdown liftoff");
  EXPECT_LT(run.final_state[3], 0.0);
}

TEST(Fall, ByNoReturnAtAnApexBelowTouchdownHeight) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.theta_td = Degrees(-10.0);
  q.initial[2] = 0.6;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kFellNoReturn);
  EXPECT_EQ(EventNames(run), "touchdown liftoff apex");
}

TEST(Fall, LeavesLaterRowsMissing) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.theta_td = Degrees(-10.0);
  q.initial[2] = 1.2;
  const double end = Simulate(q).end_time;
  const std::array times = {0.5 * end, end + 0.01, end + 1.0};
  const std::array directions = {D::InitialState(0)};
  q.row_times = times;
  q.channels = kBody;
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

// ---- event location ----------------------------------------------------------------------

TEST(EventLocation, TouchdownAndApexLieOnTheirGuards) {
  for (Law law : kCLegLaws) {
    const SimulationRequest q = ThickLegRequest(law);
    const Trajectory run = Simulate(q);
    ASSERT_EQ(EventNames(run), "touchdown liftoff apex");  // each once
    const double height = q.parameters.r * (1.0 + std::cos(q.parameters.theta_td));
    EXPECT_NEAR(run.events[0].y / height, 1.0, kEventResidual);
    EXPECT_NEAR(run.events[2].vy, 0.0, kEventResidual);
  }
}

TEST(EventLocation, LiftoffLiesWhereTheChordForceVanishes) {
  for (Law law : kCLegLaws) {
    SimulationRequest q = ThickLegRequest(law);
    const Trajectory hop = Simulate(q);
    q.horizon = hop.events[1].time - 1e-13;
    const std::array times = {q.horizon};
    const std::array channels = {Channel::kGroundForceX, Channel::kGroundForceY};
    q.row_times = times;
    q.channels = channels;
    const Trajectory run = Simulate(q);
    const double weight = q.parameters.m * q.parameters.g;
    // The last 1e-13 s bring 1e-13 s times the crossing rate of force.
    EXPECT_NEAR(std::hypot(run.samples[0], run.samples[1]) / weight, 0.0,
                kEventResidual + 1e-13 * std::abs(hop.events[1].crossing_rate));
  }
}

TEST(EventLocation, DoesNotDependOnTheSolverTolerance) {
  // On the same flow the located crossing is exact; what differs is the flow.
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.integrator.relative_tolerance = 1e-6;
  q.integrator.absolute_tolerance = 1e-7;
  const Trajectory run = Simulate(q);
  EXPECT_NEAR(run.events[2].vy, 0.0, kEventResidual);
  const double height = q.parameters.r * (1.0 + std::cos(q.parameters.theta_td));
  EXPECT_NEAR(run.events[0].y / height, 1.0, kEventResidual);
}

TEST(Rows, AtAnEventShowTheStateOfTheEvent) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const Trajectory hop = Simulate(q);
  std::vector<double> times;
  for (const Event& e : hop.events) times.push_back(e.time);
  q.row_times = times;
  q.channels = kBody;
  const Trajectory run = Simulate(q);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Event& e = hop.events[i];
    EXPECT_TRUE(MatrixNear({&run.samples[i * 4], 4}, std::array{e.x, e.y, e.vx, e.vy}, 1e-12));
  }
}

TEST(Rows, AtOneAndTheSameTimeAreEqual) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const std::array times = {0.12, 0.12, 0.12};
  q.row_times = times;
  q.channels = kBody;
  const Trajectory run = Simulate(q);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(run.samples[i], run.samples[i + 4]);
}

TEST(Rows, ChangeTheRunByNoMoreThanRounding) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const Trajectory plain = Simulate(q);
  const auto times = EvenTimes(plain.end_time, 100);
  q.row_times = times;
  q.channels = kBody;
  // Reading inside a step evaluates the law once more, and the next root search starts elsewhere.
  EXPECT_TRUE(MatrixNear(Simulate(q).final_state, plain.final_state, 100 * kEps));
}

TEST(Rows, BeforeTheStartLieOnTheBackwardFlight) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const std::array times = {-0.05, -0.02, 0.0};
  q.row_times = times;
  q.channels = kBody;
  const Trajectory run = Simulate(q);
  for (int i = 0; i < 3; ++i) {
    const double t = times[i], g = q.parameters.g;
    const std::array expected = {q.initial[0] + q.initial[2] * t,
                                 q.initial[1] + q.initial[3] * t - 0.5 * g * t * t, q.initial[2],
                                 q.initial[3] - g * t};
    EXPECT_TRUE(MatrixNear({&run.samples[i * 4], 4}, expected, kClosedForm));
  }
}

TEST(Rows, BeforeTheStartWithAirDragFlyForwardToTheStart) {
  for (IntegratorKind kind :
       {IntegratorKind::kDop853, IntegratorKind::kErkStep, IntegratorKind::kCvodes}) {
    SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
    std::array effects = {EffectSetting::Null(*FindEffect("air_drag"))};
    effects[0].values[0] = 0.5;
    const std::array times = {-0.07, -0.03};
    q.integrator.kind = kind;
    q.effects = effects;
    q.row_times = times;
    q.channels = kBody;
    if (kind == IntegratorKind::kCvodes) q.integrator = {kind, 1e-11, 1e-12};
    const Trajectory back = Simulate(q);
    for (int row = 0; row < 2; ++row) {
      SimulationRequest forward = q;
      forward.row_times = {};
      std::copy_n(&back.samples[row * 4], 4, forward.initial.begin());
      forward.horizon = -times[row];
      // One-step: rounding; multistep: its tolerance times its steps.
      const Trajectory there = Simulate(forward);
      EXPECT_TRUE(MatrixNear({there.final_state.data(), 4}, q.initial,
                             kind == IntegratorKind::kCvodes ? 1e-8 : 1e-11))
          << NameOf(kind);
    }
  }
}

TEST(NumericFlight, LiftingOffBelowTouchdownHeightGoesOnAsTheClosedFormDoes) {
  for (double deg : {15.0, 24.0, 30.0}) {
    SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
    q.parameters.theta_td = Degrees(deg);
    q.max_hops = 2;
    const Trajectory closed = Simulate(q);
    std::array effects = {EffectSetting::Null(*FindEffect("air_drag"))};
    effects[0].values[0] = 1e-13;  // too little to see, enough to integrate
    q.effects = effects;
    const Trajectory numeric = Simulate(q);
    EXPECT_EQ(EventNames(numeric), EventNames(closed));
    for (std::size_t e = 0; e < closed.events.size(); ++e)
      EXPECT_NEAR(numeric.events[e].time, closed.events[e].time, 1e-10);
  }
}

TEST(Flexure, IsReportedByTheExpansionAlone) {
  for (Law law : kCLegLaws) {
    const double flexure = Simulate(ThickLegRequest(law)).max_flexure;
    if (law == Law::kLargeDeflection)
      EXPECT_GT(flexure, 0.02);
    else
      EXPECT_EQ(flexure, 0.0);
  }
}

TEST(Flexure, OfASoftLegGoesBeyondWhatTheExpansionCarries) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.E *= 0.15;
  EXPECT_GT(Simulate(q).max_flexure, kMaxFlexure);
}

TEST(Trajectory, ReusedForAnotherRunHoldsNothingOfTheFirst) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  Trajectory reused;
  q.parameters.E *= 0.25;
  Simulate(q, reused);
  q.parameters.E *= 4.0;
  Simulate(q, reused);
  const Trajectory fresh = Simulate(q);
  EXPECT_EQ(reused.final_state, fresh.final_state);
  EXPECT_EQ(reused.max_flexure, fresh.max_flexure);
  EXPECT_EQ(reused.events.size(), fresh.events.size());
  EXPECT_EQ(reused.steps, fresh.steps);
}

}  // namespace
}  // namespace hoplab
