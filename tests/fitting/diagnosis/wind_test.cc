// Balls in moving air, by a reference of their own, and seen by a rolled camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "fitting/diagnosis/diagnosis.h"
#include "fitting/diagnosis/verdict.h"
#include "tests/support/diagnosis_cases.h"
#include "tests/support/moving_air.h"

namespace hoplab {
namespace {

constexpr double kDrag = 4e-4;  // N s^2/m^2, of a table-tennis ball

Dataset BallsIn(double wind, double drag = kDrag) {
  Dataset d = testing::MakeExactDataset(Law::kBall);
  std::uint64_t stream = 0;
  for (Trial& t : d.trials) {
    const testing::BallInMovingAir air{.drag = drag,
                                       .wind = wind,
                                       .mass = t.mechanism.body_mass_kg,
                                       .g = t.mechanism.gravity_m_per_s2};
    const StateSpec& start = *t.initial;
    const std::vector<testing::BallInMovingAir::State> states =
        air.At(t.trace.time_s, {start.x_m, start.y_m, start.vx_m_per_s, start.vy_m_per_s});
    for (std::size_t c = 0; c < 2; ++c) {
      RandomStream noise(/*seed=*/3, ++stream);
      for (std::size_t i = 0; i < states.size(); ++i)
        t.trace.columns[c].values[i] = states[i][c] + 0.0007 * noise.Normal();
    }
  }
  return d;
}

TEST(Wind, IsNamedBesideTheDragWithTheSpeedOfTheAir) {
  const Diagnosis d = Diagnose(BallsIn(-2.0), {});
  EXPECT_EQ(NameOf(d.verdict), "named") << d.reason;
  std::vector<std::string> names;
  for (const Candidate& c : d.naming.best.members) names.push_back(c.Name());
  ASSERT_EQ(names, (std::vector<std::string>{"air_drag", "wind"}));
  const double drag = d.naming.best.ValuesOf(0)[0];
  const Eigen::VectorXd wind = d.naming.best.ValuesOf(1);
  EXPECT_NEAR(drag, kDrag, 0.05 * kDrag);
  EXPECT_NEAR(wind[1], -2.0, 0.1);
  EXPECT_NEAR(wind[0] / drag, -2.0, 0.1);
  // One that does not pull is none, at any speed.
  FittedModel still = d.naming.best;
  EXPECT_FALSE(still.AtNull(1));
  still.shared[still.PlaceOf(1)] = 0.0;
  EXPECT_TRUE(still.AtNull(1));
}

// What shows a wind is its pull, at any speed.
TEST(Wind, IsExcludedWhereNothingPulls) {
  const Diagnosis d = Diagnose(BallsIn(0.0, 0.0), {});
  EXPECT_EQ(NameOf(d.verdict), "adequate") << d.reason;
  const auto wind = std::find_if(
      d.naming.candidates.begin(), d.naming.candidates.end(), [](const CandidateResult& c) {
        return c.candidate.Name() == "wind" && c.candidate.only_recording.empty();
      });
  ASSERT_NE(wind, d.naming.candidates.end());
  EXPECT_EQ(wind->status, CandidateStatus::kExcluded);
  EXPECT_LT(wind->bound95[0], 0.5 * kDrag);  // half a metre a second, had it this drag
}

// A camera that is rolled by two degrees: a slope of the ground moves balls nearly so.
TEST(Look, ARolledCameraIsToldWhereASlopeWouldDo) {
  Dataset d = BallsIn(0.0);
  const double c = std::cos(0.035), s = std::sin(0.035);
  for (Trial& t : d.trials) {
    std::vector<double>&x = t.trace.columns[0].values, &y = t.trace.columns[1].values;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double along = x[i], up = y[i];
      x[i] = c * along + s * up;
      y[i] = c * up - s * along;
    }
  }
  const Diagnosis told = Diagnose(d, {});
  EXPECT_TRUE(NamesSomething(told)) << told.reason;
  bool with_roll = false;
  for (const std::vector<int>& group : told.naming.groups)
    for (const int i : group)
      with_roll =
          with_roll ||
          told.naming.candidates[static_cast<std::size_t>(i)].candidate.Name() == "camera_roll";
  EXPECT_TRUE(with_roll);
}

}  // namespace
}  // namespace hoplab
