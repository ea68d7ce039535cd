#include <gtest/gtest.h>

#include <array>

#include "tests/support/effect_requests.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;

TEST(Rows, AtAnEventShowTheStateOfTheEvent) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const Trajectory hop = Simulate(q);
  std::vector<double> times;
  for (const Event& e : hop.events) times.push_back(e.time);
  q.row_times = times;
  q.channels = kBodyChannels;
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
  q.channels = kBodyChannels;
  const Trajectory run = Simulate(q);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(run.samples[i], run.samples[i + 4]);
}

TEST(Rows, ChangeTheRunByNoMoreThanRounding) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const Trajectory plain = Simulate(q);
  const auto times = EvenTimes(plain.end_time, 100);
  q.row_times = times;
  q.channels = kBodyChannels;
  // Reading inside a step evaluates the law once more, and the next root search starts elsewhere.
  EXPECT_TRUE(MatrixNear(Simulate(q).final_state, plain.final_state, 100 * kEps));
}

TEST(Rows, BeforeTheStartLieOnTheBackwardFlight) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const std::array times = {-0.05, -0.02, 0.0};
  q.row_times = times;
  q.channels = kBodyChannels;
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
    q.channels = kBodyChannels;
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

TEST(DeflectionRatio, IsReportedByTheExpansionAlone) {
  for (Law law : kCLegLaws) {
    const double deflection_ratio = Simulate(ThickLegRequest(law)).max_deflection_ratio;
    if (law == Law::kLargeDeflection)
      EXPECT_GT(deflection_ratio, 0.02);
    else
      EXPECT_EQ(deflection_ratio, 0.0);
  }
}

TEST(DeflectionRatio, OfASoftLegGoesBeyondWhatTheExpansionCarries) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.E *= 0.15;
  EXPECT_GT(Simulate(q).max_deflection_ratio, kMaxDeflectionRatio);
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
  EXPECT_EQ(reused.max_deflection_ratio, fresh.max_deflection_ratio);
  EXPECT_EQ(reused.events.size(), fresh.events.size());
  EXPECT_EQ(reused.steps, fresh.steps);
}

}  // namespace
}  // namespace hoplab
