// What a point of a search for a robot's gait is worth.
#include <gtest/gtest.h>

#include <array>

#include "base/random.h"
#include "optimize/search_point.h"
#include "tests/support/robot_gaits.h"

namespace hoplab {
namespace {

using namespace testing;

SearchPoint ScoreOf(const Hopper& hopper, const SearchConstraints& constraints = {}) {
  SearchProblem problem;
  problem.constraints = constraints;
  problem.variables = {{"none", 0.0, 1.0}};
  problem.objective = SearchObjective::kSpectralRadius;
  problem.hopper_at = [hopper](std::span<const double>) { return hopper; };
  return EvaluatePoint(problem, std::array{0.5});
}

// The random point of this number, from 1, in the wide box of GaitsFromScratch.
Hopper RandomRobot(int number, int legs, double phase) {
  constexpr std::array<double, 6> kLow = {0.2, 0.3, 0.3, -0.3, 0.1, 0.185};
  constexpr std::array<double, 6> kHigh = {0.6, 0.8, 1.5, 0.6, 1.5, 0.25};
  RandomStream random(1, 1);
  std::array<double, 6> x = {};
  for (int point = 0; point < number; ++point)
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = random.Uniform(kLow[i], kHigh[i]);
  Hopper hopper = ClockedRobot(legs, x[0], x[1], x[2], x[3]);
  hopper.request.parameters.robot->phase[1] = phase;
  hopper.request.initial = {0.0, x[5], x[4], 0.0};
  hopper.request.integrator = {};
  return hopper;
}

// With a million steps it does not leave its first stride.
TEST(StrideSearch, ARunThatCrawlsIsGivenUp) {
  const SearchPoint point = ScoreOf(RandomRobot(5, 3, 0.5));
  EXPECT_EQ(point.verdict, PointVerdict::kRunEnded);
  EXPECT_EQ(point.outcome, Outcome::kStepLimit);
}

// It falls after some strides; the one near them is found, and tells how far from stable it is.
TEST(StrideSearch, AFallNearAnUnstableStrideIsWorthMoreThanAFall) {
  const SearchPoint near = ScoreOf(RandomRobot(42, 2, 0.0));
  EXPECT_EQ(near.verdict, PointVerdict::kNoConvergence);
  EXPECT_EQ(near.outcome, Outcome::kFellPitch);
  EXPECT_GT(near.spectral_radius, 1.0);
  EXPECT_EQ(near.gait, "pronk");
  const SearchPoint fall = ScoreOf(RandomRobot(1, 2, 0.0));
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

// The middle leg of a walk is told to be half a stride behind the others; it stands a third of one
// behind.
TEST(StrideSearch, HowFarLegsAreApartCanBeAskedFor) {
  Hopper walk = WalkingRobot();
  walk.request.integrator = {};
  const SearchPoint apart = ScoreOf(walk, {.min_legs_apart = 0.3});
  EXPECT_EQ(apart.verdict, PointVerdict::kGood);
  EXPECT_NEAR(apart.legs_apart, 0.365, 0.02);
  EXPECT_NEAR(apart.flight_share, 0.078, 0.01);
  const SearchPoint together = ScoreOf(walk, {.max_legs_apart = 0.12});
  EXPECT_EQ(together.verdict, PointVerdict::kConstraint);
  EXPECT_EQ(together.violated, "max_legs_apart");
  const SearchPoint flies = ScoreOf(walk, {.min_flight_share = 0.2});
  EXPECT_EQ(flies.violated, "min_flight_share");
  EXPECT_LT(flies.score, together.score);
}

}  // namespace
}  // namespace hoplab
