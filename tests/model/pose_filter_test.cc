#include "model/pose_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/random.h"
#include "tests/support/effect_requests.h"

namespace hoplab {
namespace {

using namespace testing;

constexpr std::array kPlaceAndRates = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVy};

std::array<EffectSetting, 1> FilterOf(const char* name, double time) {
  std::array effects = {EffectSetting::Null(*FindEffect(name))};
  effects[0].values[0] = time;
  return effects;
}
std::array<EffectSetting, 1> LowPass(double tau) { return FilterOf("sensor_low_pass", tau); }

// A ball that falls, bounces once and rises, in rows of `step` seconds.
struct OneBounce {
  SimulationRequest q = BallRequest();
  std::vector<double> rows;

  explicit OneBounce(double step) {
    q.initial = {0.0, 0.5, 0.6, 0.0};
    q.parameters.radius = 0.02;
    q.parameters.restitution = 0.8;
    q.parameters.tangential_loss = 0.0;
    q.horizon = 0.8;
    for (double t = 0.0; t < 0.5; t += step) rows.push_back(t);
    q.row_times = rows;
    q.channels = kPlaceAndRates;
  }
};

// A corner of the path, the rate of which jumps by J at t = 0, is rounded by
//     J G(t),  G'' = k - delta,  G(t) = tau/(2 sqrt 2) exp(-u) (cos u - sin u),  u = |t|/(sqrt 2
//     tau)
// with k the filter's answer to an impulse, the transform of 1/(1 + (2 pi f tau)^4).
double Rounding(double t, double tau) {
  const double u = std::abs(t) / (std::sqrt(2.0) * tau);
  return tau / (2.0 * std::sqrt(2.0)) * std::exp(-u) * (std::cos(u) - std::sin(u));
}

TEST(PoseFilter, LeavesParabolasAndRoundsTheCornerOfABounce) {
  for (const double step : {0.002, 0.0002}) {
    OneBounce bounce(step);
    const Trajectory sharp = Simulate(bounce.q);
    ASSERT_EQ(sharp.events.front().kind, EventKind::kBounce);
    const Event& hit = sharp.events.front();
    const double tau = 0.008, jump = hit.vy_after - hit.vy;
    const auto effects = LowPass(tau);
    bounce.q.effects = effects;
    const Trajectory smooth = Simulate(bounce.q);
    ASSERT_EQ(smooth.samples.size(), sharp.samples.size());
    EXPECT_EQ(smooth.rows_in_run, sharp.rows_in_run);
    // Rows of `step` see the corner as a chord of up to step jump/4 off, for a time of step.
    const double sees = step * step * jump / (8.0 * 2.0 * std::sqrt(2.0) * tau);
    double rounded = 0.0;
    for (std::size_t row = 0; row < bounce.rows.size(); ++row) {
      EXPECT_NEAR(smooth.samples[3 * row], sharp.samples[3 * row], 1e-9);
      const double by = smooth.samples[3 * row + 1] - sharp.samples[3 * row + 1];
      EXPECT_NEAR(by, jump * Rounding(bounce.rows[row] - hit.time, tau), 1.1 * sees) << step;
      EXPECT_EQ(smooth.samples[3 * row + 2], sharp.samples[3 * row + 2]);  // a rate
      rounded = std::max(rounded, by);
    }
    EXPECT_GT(rounded, 0.01);
  }
}

TEST(PoseFilter, NoFilterIsTheRunItself) {
  OneBounce bounce(0.004);
  const Trajectory plain = Simulate(bounce.q);
  const auto effects = LowPass(0.0);
  const std::array directions = {SensitivityDirection::EffectParameter(0, 0)};
  bounce.q.effects = effects;
  bounce.q.directions = directions;
  const Trajectory run = Simulate(bounce.q);
  EXPECT_EQ(run.samples, plain.samples);
  for (const double slope : run.sensitivities) EXPECT_EQ(slope, 0.0);
}

TEST(PoseFilter, ItsDerivativeByTauIsThatOfTheClosedForm) {
  OneBounce bounce(0.0002);
  const double tau = 0.008, h = 1e-6;
  const auto effects = LowPass(tau);
  const std::array directions = {SensitivityDirection::EffectParameter(0, 0)};
  bounce.q.effects = effects;
  bounce.q.directions = directions;
  const Trajectory run = Simulate(bounce.q);
  const Event& hit = run.events.front();
  double largest = 0.0;
  for (std::size_t row = 0; row < bounce.rows.size(); ++row) {
    const double t = bounce.rows[row] - hit.time;
    const double expected =
        (hit.vy_after - hit.vy) * (Rounding(t, tau + h) - Rounding(t, tau - h)) / (2.0 * h);
    EXPECT_NEAR(run.sensitivities[3 * row + 1], expected, 2e-4);
    largest = std::max(largest, std::abs(expected));
  }
  EXPECT_GT(largest, 1.0);
}

// M117 of a bounce: what filters make of a parabola and of its corner, in closed form. A corner of
// which the rate jumps by J from t = 0 on comes out as J R(t).
struct LateFilter {
  const char* name;
  double time;
  double lag, curve;  // of y'(t) and of y''(t), what is added
  double (*ramp)(double t, double time);
};
double RampOfOnePass(double t, double time) {
  const double v = t / (std::sqrt(2.0) * time);
  return t > 0.0 ? t - std::sqrt(2.0) * time * (1.0 - std::exp(-v) * std::cos(v)) : 0.0;
}
double RampOfFirstOrder(double t, double time) {
  return t > 0.0 ? t - time * (1.0 - std::exp(-t / time)) : 0.0;
}
double RampOfAverage(double t, double width) {
  if (std::abs(t) >= 0.5 * width) return std::max(t, 0.0);
  return (t + 0.5 * width) * (t + 0.5 * width) / (2.0 * width);
}
constexpr LateFilter kLate[] = {
    {"sensor_causal_low_pass", 0.008, -0.008 * 1.4142135623730951, 0.008 * 0.008, &RampOfOnePass},
    {"sensor_exponential_filter", 0.008, -0.008, 0.008 * 0.008, &RampOfFirstOrder},
    {"sensor_moving_average", 0.03, 0.0, 0.03 * 0.03 / 24.0, &RampOfAverage},
};

TEST(PoseFilter, OtherShapesOfABounceInClosedForm) {
  for (const LateFilter& filter : kLate) {
    OneBounce bounce(0.0002);
    const Trajectory sharp = Simulate(bounce.q);
    const Event& hit = sharp.events.front();
    const double jump = hit.vy_after - hit.vy, vx_jump = hit.vx_after - hit.vx;
    const auto effects = FilterOf(filter.name, filter.time);
    const std::array directions = {SensitivityDirection::EffectParameter(0, 0)};
    bounce.q.effects = effects;
    bounce.q.directions = directions;
    const Trajectory run = Simulate(bounce.q);
    ASSERT_EQ(vx_jump, 0.0);
    const double h = 1e-6, g = bounce.q.parameters.g;
    // The path before the bounce, which the filter sees go on, and the corner's part.
    const auto expected = [&](double t, double time) {
      const double part = time / filter.time, lag = part * filter.lag,
                   curve = part * part * filter.curve;
      const double y = 0.5 - 0.5 * g * t * t + lag * -g * t + curve * -g;
      return y + jump * filter.ramp(t - hit.time, time);
    };
    double most = 0.0;
    for (std::size_t row = 0; row < bounce.rows.size(); ++row) {
      const double t = bounce.rows[row];
      EXPECT_NEAR(run.samples[3 * row + 1], expected(t, filter.time), 3e-6) << filter.name << t;
      EXPECT_NEAR(run.samples[3 * row], 0.6 * (t + filter.lag), 1e-6) << filter.name << t;
      const double slope = (expected(t, filter.time + h) - expected(t, filter.time - h)) / (2 * h);
      EXPECT_NEAR(run.sensitivities[3 * row + 1], slope, 3e-3) << filter.name << t;
      most = std::max(most, std::abs(slope));
    }
    EXPECT_GT(most, 0.4) << filter.name;
  }
}

// However short their times against the rows' distance, what is late is late by the right time.
TEST(PoseFilter, AShortLagIsRight) {
  for (const double share : {0.1, 0.3, 0.7, 1.5}) {
    OneBounce bounce(0.004);
    const double time = share * 0.004, vx = 0.6;
    for (const LateFilter& filter : {kLate[0], kLate[1]}) {
      const auto effects = FilterOf(filter.name, time);
      const std::array directions = {SensitivityDirection::EffectParameter(0, 0)};
      bounce.q.effects = effects;
      bounce.q.directions = directions;
      const Trajectory run = Simulate(bounce.q);
      const double lag = filter.lag / filter.time;
      for (std::size_t row = 0; row < bounce.rows.size(); ++row) {
        EXPECT_NEAR(run.samples[3 * row], vx * (bounce.rows[row] + lag * time), 1e-9) << share;
        EXPECT_NEAR(run.sensitivities[3 * row], vx * lag, 1e-6) << share;
      }
    }
  }
}

// Two in turn: filters may change places.
TEST(PoseFilter, TwoActInTurn) {
  OneBounce bounce(0.001);
  std::array effects = {EffectSetting::Null(*FindEffect("sensor_low_pass")),
                        EffectSetting::Null(*FindEffect("sensor_exponential_filter"))};
  effects[0].values[0] = 0.006;
  effects[1].values[0] = 0.004;
  const std::array directions = {SensitivityDirection::EffectParameter(0, 0),
                                 SensitivityDirection::EffectParameter(1, 0)};
  bounce.q.effects = effects;
  bounce.q.directions = directions;
  const Trajectory run = Simulate(bounce.q);
  std::swap(effects[0], effects[1]);
  const Trajectory turned = Simulate(bounce.q);
  const std::array<EffectSetting, 1> one = {effects[0]};
  bounce.q.effects = one;
  bounce.q.directions = {};
  const Trajectory alone = Simulate(bounce.q);
  double apart = 0.0, moved = 0.0;
  for (std::size_t row = 40; row + 40 < bounce.rows.size(); ++row) {
    const std::size_t cell = 3 * row + 1;
    apart = std::max(apart, std::abs(run.samples[cell] - turned.samples[cell]));
    moved = std::max(moved, std::abs(run.samples[cell] - alone.samples[cell]));
    for (const std::size_t k : {0, 1})
      EXPECT_NEAR(run.sensitivities[2 * cell + k], turned.sensitivities[2 * cell + 1 - k], 2e-3);
  }
  EXPECT_LT(apart, 1e-6);
  EXPECT_GT(moved, 1e-3);
}

// A channel with a clock of its own is read beyond the end of the run: rows that one of the
// filtered channels lacks are left out of the means.
TEST(PoseFilter, NeverTakesARowThatAChannelLacks) {
  OneBounce bounce(0.002);
  bounce.q.horizon = 0.51;
  const std::array offsets = {0.005};
  const std::array clocks = {-1, 0, -1};
  bounce.q.clock_offsets = offsets;
  bounce.q.channel_clocks = clocks;
  const auto effects = LowPass(0.004);
  bounce.q.effects = effects;
  const Trajectory run = Simulate(bounce.q);
  for (const double sample : run.samples) EXPECT_TRUE(std::isfinite(sample));
}

// As filters do that are run to and fro over evenly sampled columns.
TEST(PoseFilter, TakesNoiseDownByTheShareOfItsBand) {
  RandomStream random(5, 0);
  const double step = 0.002, tau = 0.01;
  std::vector<double> times, noise;
  for (int i = 0; i < 20000; ++i) {
    times.push_back(step * i);
    noise.push_back(random.Normal());
  }
  double square = 0.0;
  for (const double value : ThroughFilter({tau, 0}, times, noise)) square += value * value;
  // The integral of 1/(1 + (2 pi f tau)^4)^2 over f is 3/(8 sqrt 2 tau) of a density `step`.
  const double expected = 3.0 * step / (8.0 * std::sqrt(2.0) * tau);
  EXPECT_NEAR(square / static_cast<double>(noise.size()) / expected, 1.0, 0.05);
}

}  // namespace
}  // namespace hoplab
