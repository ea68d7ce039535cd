// Balls whose motion comes from a reference of the test's own.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/units.h"
#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/diagnosis_cases.h"
#include "tests/support/moving_air.h"

namespace hoplab {
namespace {

std::vector<std::string> NamesOf(const Diagnosis& d) {
  std::vector<std::string> names;
  for (const Candidate& c : d.naming.best.members) names.push_back(c.Name());
  return names;
}

// Tennis balls fall 35 m and are filmed at 15 Hz, both coordinates, until half a metre above
// ground.
Dataset LongFalls() {
  constexpr double kNoise = 0.02;
  Dataset d = testing::MakeExactDataset(Law::kBall);
  for (ChannelSpec& c : d.channels) c.sigma = kNoise;
  std::uint64_t stream = 0;
  double height = 34.0;
  for (Trial& t : d.trials) {
    t.mechanism.body_mass_kg = 0.0577;
    t.initial = StateSpec{};
    t.initial->y_m = height += 0.2;
    const testing::BallInMovingAir air{.drag = 1.2e-3,
                                       .wind = 0.0,
                                       .mass = t.mechanism.body_mass_kg,
                                       .g = t.mechanism.gravity_m_per_s2};
    std::vector<double> times;
    for (int i = 0; i < 60; ++i) times.push_back(i / 15.0);
    auto states = air.At(times, {0.0, height, 0.0, 0.0});
    std::size_t rows = 0;
    while (rows < states.size() && states[rows][1] > 0.5 && states[rows][3] <= 0.0) ++rows;
    t.trace.time_s.assign(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(rows));
    for (std::size_t c = 0; c < t.trace.columns.size(); ++c) {
      RandomStream noise(/*seed=*/5, ++stream);
      t.trace.columns[c].values.clear();
      for (std::size_t i = 0; i < rows; ++i)
        t.trace.columns[c].values.push_back(states[i][c] + kNoise * noise.Normal());
    }
  }
  return d;
}

// Without drag the ball is down before the film ends, and the fit of that bends a bounce that is
// not there. What it left of the bounce says nothing where none is.
TEST(Balls, ThatDoNotBounceSayNothingOfABounce) {
  const Dataset falls = LongFalls();
  const Diagnosis d = Diagnose(falls, {});
  EXPECT_EQ(NameOf(d.verdict), "named") << d.reason;
  ASSERT_EQ(NamesOf(d), std::vector<std::string>{"air_drag"});
  EXPECT_NEAR(d.naming.best.ValuesOf(0)[0], 1.2e-3, 5e-5);
  for (int k = 0; k < d.problem.shared_count(); ++k) {
    const SharedParameter& s = d.problem.shared[static_cast<std::size_t>(k)];
    EXPECT_EQ(d.naming.best.shared[k], s.initial) << s.name;
  }
}

// Balls that stay on the ground for `contact` [s] at each bounce, half a sine deep; parabolas
// between.
Dataset BallsOnTheGroundFor(double contact) {
  Dataset d = testing::MakeExactDataset(Law::kBall);
  std::uint64_t stream = 0;
  for (Trial& t : d.trials) {
    const BallSpec& ball = t.mechanism.ball;
    const double g = t.mechanism.gravity_m_per_s2;
    double begin = 0.0, x = t.initial->x_m, y = t.initial->y_m;
    double vx = t.initial->vx_m_per_s, vy = t.initial->vy_m_per_s;
    RandomStream noise(/*seed=*/7, ++stream);
    for (std::size_t i = 0; i < t.trace.time_s.size(); ++i) {
      const double speed = std::sqrt(vy * vy + 2.0 * g * (y - ball.radius_m));
      const double lands = (vy + speed) / g, on_ground = vx * (1.0 - 0.5 * ball.tangential_loss);
      const double since = t.trace.time_s[i] - begin, after = since - lands;
      if (after > contact) {
        x += vx * lands + on_ground * contact;
        y = ball.radius_m;
        vx *= 1.0 - ball.tangential_loss;
        vy = ball.restitution * speed;
        begin += lands + contact;
        --i;  // the same row in the next flight
        continue;
      }
      const double at_x = after < 0.0 ? x + vx * since : x + vx * lands + on_ground * after;
      const double at_y =
          after < 0.0 ? y + since * (vy - 0.5 * g * since)
                      : ball.radius_m - speed * contact / kPi * std::sin(kPi * after / contact);
      t.trace.columns[0].values[i] = at_x + 0.0007 * noise.Normal();
      t.trace.columns[1].values[i] = at_y + 0.0007 * noise.Normal();
    }
  }
  return d;
}

// It was told as the height of the ground.
TEST(Balls, ThatGiveWayAreOnTheGroundForATime) {
  const Diagnosis d = Diagnose(BallsOnTheGroundFor(0.004), {});
  EXPECT_EQ(NameOf(d.verdict), "named") << d.reason;
  ASSERT_EQ(NamesOf(d), std::vector<std::string>{"contact_time"});
  EXPECT_NEAR(d.naming.best.ValuesOf(0)[0], 0.004, 1e-4);
}

TEST(Balls, ThatDoNotGiveWayHaveNoContactTime) {
  const Diagnosis d = Diagnose(BallsOnTheGroundFor(0.0), {});
  EXPECT_EQ(NameOf(d.verdict), "adequate") << d.reason;
}

}  // namespace
}  // namespace hoplab
