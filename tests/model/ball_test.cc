#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/units.h"
#include "tests/support/bouncing_ball.h"
#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;
using B = BouncingBall;
using D = SensitivityDirection;

const std::array<D, B::kCount> kDirections = {D::Parameter(ParameterId::kRestitution),
                                              D::Parameter(ParameterId::kTangentialLoss),
                                              D::Parameter(ParameterId::kGravity),
                                              D::Parameter(ParameterId::kRadius),
                                              D::InitialState(0),
                                              D::InitialState(1),
                                              D::InitialState(2),
                                              D::InitialState(3)};
constexpr int kBounces = 10;

BouncingBall ClosedFormOf(const SimulationRequest& q) {
  const auto& p = q.parameters;
  return {p.restitution, p.tangential_loss, p.g,          p.radius,
          q.initial[0],  q.initial[1],      q.initial[2], q.initial[3]};
}

std::vector<Event> BouncesOf(const Trajectory& run) {
  std::vector<Event> bounces;
  for (const Event& e : run.events) {
    if (e.kind == EventKind::kBounce) bounces.push_back(e);
  }
  return bounces;
}

// Ends between bounce 10 and 11 of the closed form.
SimulationRequest TenBounces() {
  SimulationRequest q = BallRequest();
  const auto bounces = ClosedFormOf(q).Bounces(kBounces + 1);
  q.horizon =
      static_cast<double>(0.6L * bounces[kBounces - 1].time + 0.4L * bounces[kBounces].time);
  q.directions = kDirections;
  return q;
}

TEST(Ball, BounceTimesAndStatesOverTenBouncesMatchTheClosedForm) {
  const SimulationRequest q = TenBounces();
  const Trajectory run = Simulate(q);
  ASSERT_EQ(run.outcome, Outcome::kCompleted);
  const auto found = BouncesOf(run);
  const auto exact = ClosedFormOf(q).Bounces(kBounces);
  ASSERT_EQ(found.size(), exact.size());
  for (int n = 0; n < kBounces; ++n) {
    EXPECT_LT(RelativeError(found[n].time, exact[n].time), kTenBounces) << n;
    EXPECT_LT(RelativeError(found[n].x, exact[n].position), kTenBounces) << n;
    EXPECT_LT(RelativeError(-found[n].vy, exact[n].speed), kTenBounces) << n;
  }
  const auto last = ClosedFormOf(q).StateAt(q.horizon, kBounces);
  for (int i = 0; i < 4; ++i)
    EXPECT_LT(RelativeError(run.final_state[i], last.z[i]), kTenBounces) << i;
}

TEST(Ball, DerivativesOfBounceTimesMatchTheClosedForm) {
  const SimulationRequest q = TenBounces();
  const Trajectory run = Simulate(q);
  const auto exact = ClosedFormOf(q).Bounces(kBounces);
  int n = 0;
  for (std::size_t e = 0; e < run.events.size(); ++e) {
    if (run.events[e].kind != EventKind::kBounce) continue;
    std::array<double, B::kCount> expected;
    std::copy(exact[n].d_time.begin(), exact[n].d_time.end(), expected.begin());
    EXPECT_TRUE(MatrixNear({&run.event_time_sensitivities[e * B::kCount], B::kCount}, expected,
                           kTenBounces))
        << "bounce " << n;
    ++n;
  }
  EXPECT_EQ(n, kBounces);
}

TEST(Ball, DerivativesOfTheStateAfterTenBouncesMatchTheClosedForm) {
  const SimulationRequest q = TenBounces();
  const Trajectory run = Simulate(q);
  const auto exact = ClosedFormOf(q).StateAt(q.horizon, kBounces);
  for (int i = 0; i < 4; ++i) {
    std::array<double, B::kCount> expected;
    std::copy(exact.d[i].begin(), exact.d[i].end(), expected.begin());
    EXPECT_TRUE(
        MatrixNear({&run.final_sensitivities[i * B::kCount], B::kCount}, expected, kTenBounces))
        << "component " << i;
  }
}

TEST(Ball, SampledRowsBetweenBouncesMatchTheClosedForm) {
  SimulationRequest q = TenBounces();
  std::vector<double> times;
  const auto bounces = ClosedFormOf(q).Bounces(kBounces);
  for (int n = 0; n + 1 < kBounces; ++n)
    times.push_back(0.3 * bounces[n].time + 0.7 * bounces[n + 1].time);
  const std::array channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx,
                               Channel::kBodyVy};
  q.row_times = times;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  for (std::size_t row = 0; row < times.size(); ++row) {
    const auto exact = ClosedFormOf(q).StateAt(times[row], static_cast<int>(row) + 1);
    for (int c = 0; c < 4; ++c) {
      EXPECT_LT(RelativeError(run.samples[row * 4 + c], exact.z[c]), kTenBounces);
      std::array<double, B::kCount> expected;
      std::copy(exact.d[c].begin(), exact.d[c].end(), expected.begin());
      EXPECT_TRUE(MatrixNear({&run.sensitivities[(row * 4 + c) * B::kCount], B::kCount}, expected,
                             kTenBounces));
    }
  }
}

// M114, of a table-tennis ball.
TEST(Ball, FallsSlowerByTheAirInItsPlace) {
  SimulationRequest q = BallRequest();
  q.parameters.m = 0.0027;
  q.parameters.radius = 0.02;
  q.parameters.air_density = 1.2;
  q.initial = {0.0, 5.0, 0.0, 0.0};
  q.horizon = 0.9;
  const std::array directions = {D::Parameter(ParameterId::kM), D::Parameter(ParameterId::kRadius)};
  q.directions = directions;
  const Trajectory run = Simulate(q);
  const double share = 1.5 * 1.2 * 4.0 / 3.0 * kPi * 8e-6 / 0.0027;
  const double fall = 0.5 * q.parameters.g * 0.81 / (1.0 + share);
  EXPECT_NEAR(share, 0.0223, 1e-4);
  EXPECT_NEAR(run.final_state[1], 5.0 - fall, 1e-12);
  EXPECT_NEAR(run.final_state[3], -2.0 * fall / 0.9, 1e-12);
  const double by_share = fall / (1.0 + share);
  const double by_mass = -by_share * share / 0.0027, by_radius = by_share * 3.0 * share / 0.02;
  EXPECT_LT(RelativeError(run.final_sensitivities[1 * 2 + 0], by_mass), 1e-12);
  EXPECT_LT(RelativeError(run.final_sensitivities[1 * 2 + 1], by_radius), 1e-12);
}

// M115: each bounce puts off what follows by the contact time, and x goes on meanwhile.
TEST(Ball, AContactTimePutsOffEachFlight) {
  constexpr double kContact = 0.004;
  SimulationRequest q = TenBounces();
  std::array effects = {EffectSetting::Null(*FindEffect("contact_time"))};
  const std::array of_contact = {D::EffectParameter(0, 0)};
  const std::array channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx,
                               Channel::kBodyVy};
  q.effects = effects;
  q.directions = of_contact;
  q.channels = channels;
  const B ball = ClosedFormOf(q);
  const auto bounces = ball.Bounces(kBounces);
  for (const double contact : {0.0, 5e-8, kContact}) {
    effects[0].values[0] = contact;
    q.horizon = static_cast<double>(bounces.back().time) + kBounces * contact;
    std::vector<double> times;
    for (int n = 1; n < kBounces; ++n)
      times.push_back(0.3 * bounces[n - 1].time + 0.7 * bounces[n].time + n * contact);
    q.row_times = times;
    const Trajectory run = Simulate(q);
    ASSERT_EQ(run.outcome, Outcome::kCompleted);
    long double on_ground = 0.0L;  // how far it goes there, per time
    for (int n = 1; n < kBounces; ++n) {
      const long double share = 1.0L - ball.tangential_loss;
      on_ground += std::pow(share, n - 1) * ball.vx * (1.0L + share) / 2.0L;
      const std::size_t row = static_cast<std::size_t>(n - 1);
      const auto free = ball.StateAt(times[row] - n * contact, n).z;
      const std::array expected = {free[0] + contact * on_ground, free[1], free[2], free[3]};
      const std::array slope = {on_ground - n * free[2], -n * free[3], 0.0L, n * ball.g};
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_NEAR(run.samples[row * 4 + c], static_cast<double>(expected[c]), 1e-9) << c;
        EXPECT_NEAR(run.sensitivities[row * 4 + c], static_cast<double>(slope[c]), 3e-6) << c;
      }
    }
  }
}

TEST(Ball, OnTheGroundItGoesDownAndUpAgain) {
  constexpr double kContact = 0.004;
  SimulationRequest q = BallRequest();
  const std::array effects = {Setting("contact_time", kContact)};
  const std::array channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVy,
                               Channel::kContact};
  const B::Bounce bounce = ClosedFormOf(q).Bounces(1)[0];
  std::vector<double> times;
  for (int i = 1; i < 8; ++i)
    times.push_back(static_cast<double>(bounce.time) + i * kContact / 8.0);
  q.effects = effects;
  q.channels = channels;
  q.row_times = times;
  const Trajectory run = Simulate(q);
  const double speed = static_cast<double>(bounce.speed);
  for (int i = 1; i < 8; ++i) {
    const double* seen = &run.samples[static_cast<std::size_t>(i - 1) * 4];
    EXPECT_NEAR(seen[0], static_cast<double>(bounce.position) + 0.95 * 0.7 * i * kContact / 8.0,
                1e-9);
    EXPECT_NEAR(seen[1], q.parameters.radius - speed * kContact / kPi * std::sin(kPi * i / 8.0),
                1e-9);
    EXPECT_NEAR(seen[2], -speed * std::cos(kPi * i / 8.0), 1e-7);
    EXPECT_EQ(seen[3], 1.0);
  }
  q.channels = std::span(channels).first(3);
  q.directions = kDirections;
  for (const ColumnCheck& check : CheckGradient(q)) EXPECT_EQ(Complaint(check), "");
}

TEST(Ball, BouncesThatCrowdTogetherEndAtRest) {
  SimulationRequest q = BallRequest();
  q.horizon = 100.0;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kCameToRest);
  const B ball = ClosedFormOf(q);
  // Sum of the geometric series of intervals.
  const long double w = ball.Bounces(1)[0].speed;
  const long double limit =
      ball.Bounces(1)[0].time + 2.0L * w / ball.g * ball.restitution / (1.0L - ball.restitution);
  // What is left when an interval is 1e-6 s: that times e/(1-e).
  EXPECT_LT(run.end_time, limit);
  EXPECT_NEAR(run.end_time, limit, 1e-5);
  // With a contact time it stands longer than it flies, and rests as well.
  const std::array effects = {Setting("contact_time", 0.001)};
  q.effects = effects;
  const Trajectory longer = Simulate(q);
  EXPECT_EQ(longer.outcome, Outcome::kCameToRest);
  EXPECT_NEAR(longer.end_time, run.end_time + 0.001 * (BouncesOf(run).size() - 1), 1e-9);
}

}  // namespace
}  // namespace hoplab
