// What a point of a search for a robot's gait is worth.
#include <gtest/gtest.h>

#include <array>

#include "base/random.h"
#include "optimize/search_point.h"
#include "tests/support/robot_gaits.h"

namespace hoplab {
namespace {

using namespace testing;

SearchPoint ScoreOf(const Hopper& hopper) {
  SearchProblem problem;
  problem.variables = {{"none", 0.0, 1.0}};
  problem.objective = SearchObjective::kSpectralRadius;
  problem.hopper_at = [hopper](std::span<const double>) { return hopper; };
  return EvaluatePoint(problem, std::array{0.5});
}

// The 25th random point of the wide box of GaitsFromScratch: with steps without end it takes
// 785 000 of them in its 17th stride and ends as integration_failed.
TEST(StrideSearch, ARunThatCrawlsIsGivenUp) {
  constexpr std::array<double, 6> kLow = {0.2, 0.3, 0.3, -0.3, 0.1, 0.185};
  constexpr std::array<double, 6> kHigh = {0.6, 0.8, 1.5, 0.6, 1.5, 0.25};
  RandomStream random(1, 1);
  std::array<double, 6> x = {};
  for (int point = 0; point < 25; ++point)
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = random.Uniform(kLow[i], kHigh[i]);
  Hopper hopper = ClockedRobot(3, x[0], x[1], x[2], x[3]);
  hopper.request.parameters.robot->phase[1] = 0.5;
  hopper.request.initial = {0.0, x[5], x[4], 0.0};
  hopper.request.integrator = {};
  const SearchPoint point = ScoreOf(hopper);
  EXPECT_EQ(point.verdict, PointVerdict::kRunEnded);
  EXPECT_EQ(point.outcome, Outcome::kStepLimit);
}

// It falls after some ten strides; the stride near them is found, and tells how far from stable.
TEST(StrideSearch, AFallNearAnUnstableStrideIsWorthMoreThanAFall) {
  Hopper pronk = PronkingRobot();
  pronk.request.integrator = {};
  const SearchPoint near = ScoreOf(pronk);
  EXPECT_EQ(near.verdict, PointVerdict::kNoConvergence);
  EXPECT_NE(near.outcome, Outcome::kCompleted);
  EXPECT_NEAR(near.spectral_radius, 3.81, 0.02);
  EXPECT_EQ(near.gait, "pronk");
  pronk.request.initial[4] = 0.5;  // nose up: it falls at once
  const SearchPoint fall = ScoreOf(pronk);
  EXPECT_EQ(fall.verdict, PointVerdict::kRunEnded);
  EXPECT_GT(fall.score, near.score);
}

TEST(StrideSearch, AStableStrideThatItsStartLeadsToIsGood) {
  Hopper walk = WalkingRobot();
  walk.request.integrator = {};
  const SearchPoint point = ScoreOf(walk);
  EXPECT_EQ(point.verdict, PointVerdict::kGood);
  EXPECT_NEAR(point.objective, 0.8203, 0.001);
}

}  // namespace
}  // namespace hoplab
