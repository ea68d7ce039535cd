// Balls whose motion comes from a reference of the test's own.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
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

}  // namespace
}  // namespace hoplab
