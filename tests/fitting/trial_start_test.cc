// Where a trial begins that states no start.
#include "fitting/trial_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/apex_segments.h"
#include "fitting/turning_rows.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab {
namespace {

// A ball that bounces three times and comes down to a fourth, every ninth sample missing; its start
// is not stated.
Dataset BouncingBalls(double rate_hz, double sigma_m) {
  Scenario s = testing::HopScenario(4);
  s.law = "ball";
  s.mechanism.type = MechanismKind::kBall;
  s.mechanism.ball = {.radius_m = 0.033, .restitution = 0.76, .tangential_loss = 0.2};
  s.dataset->sample_rate_hz = rate_hz;
  s.dataset->channels = {{Channel::kBodyX, sigma_m}, {Channel::kBodyY, sigma_m}};
  s.dataset->trials.resize(2);
  s.dataset->initial_sigma.reset();
  for (GenerateTrial& t : s.dataset->trials) {
    t.mechanism = s.mechanism;
    t.touchdown_angle_rad = 0.0;
    t.initial = StateSpec{0.0, 1.1, 0.9, 0.4};
  }
  Dataset d = GenerateDataset(s, {.seed = 5}).dataset;
  for (Trial& t : d.trials) {
    t.initial.reset();
    for (TraceColumn& column : t.trace.columns)
      for (std::size_t row = 4; row < column.values.size(); row += 9)
        column.values[row] = std::nan("");
  }
  return d;
}

TEST(TrialStart, OfABallIsReadFromTheFlightBeforeItsFirstBounce) {
  for (const double rate : {15.0, 30.0, 120.0, 500.0}) {
    for (const double sigma : {0.0002, 0.002}) {
      SCOPED_TRACE(std::to_string(rate) + " Hz, noise " + std::to_string(sigma));
      const FitProblem problem = MakeProblem(BouncingBalls(rate, sigma), {});
      for (const TrialProblem& t : problem.trials) {
        EXPECT_NEAR(t.start[1], 1.1, 4.0 * sigma);
        EXPECT_NEAR(t.start[2], 0.9, 15.0 * sigma);
        EXPECT_NEAR(t.start[3], 0.4, 15.0 * sigma);
        EXPECT_EQ(HopsInData(problem, t), 3);
      }
    }
  }
}

TEST(TurningRows, NoiseAndAFlightTurnNothing) {
  const auto flight = [](int row) { return 0.3 - 1e-4 * row * row + 0.002 * (row % 2); };
  EXPECT_TRUE(TurningRows(flight, 40, 0.002).empty());
  EXPECT_TRUE(TurningRows(flight, 0, 0.002).empty());
  const auto bounces = [](int row) { return std::abs(std::cos(0.3 * row)); };
  EXPECT_EQ(TurningRows(bounces, 20, 0.002), (std::vector<int>{5, 16}));
}

}  // namespace
}  // namespace hoplab
