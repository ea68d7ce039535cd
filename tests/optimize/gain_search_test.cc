#include "optimize/gain_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimize/robustness.h"
#include "tests/support/gain_problem.h"

namespace hoplab {
namespace {

using testing::GainProblem;

// A short horizon: small enough for the quick suite.
SearchProblem SmallProblem(SearchObjective objective = SearchObjective::kConvergenceTime) {
  SearchProblem problem = GainProblem(objective);
  problem.hopper_at = [inner = problem.hopper_at](std::span<const double> x) {
    Hopper hopper = inner(x);
    hopper.request.horizon = 5.0;
    return hopper;
  };
  return problem;
}

GainSearchOptions SmallOptions() {
  GainSearchOptions options;
  options.budget = 80;
  options.seeds = 2;
  return options;
}

TEST(GainSearch, IsNotWorseThanAGridWithMoreEvaluations) {
  const SearchProblem problem = SmallProblem();
  double grid = std::numeric_limits<double>::infinity();
  const std::vector<double> at = {0.0, 0.0};
  for (const MapCell& cell : MapObjective(problem, at, 20, 2))
    grid = std::min(grid, cell.point.score);
  GainSearchOptions options = SmallOptions();
  options.budget = 200;
  options.jobs = 2;
  for (const SeedResult& seed : SearchGains(problem, options).seeds) {
    EXPECT_LE(seed.best.score, grid) << seed.seed;
    EXPECT_LE(seed.evaluations, 200);
  }
}

TEST(GainSearch, JobsDoNotChangeTheResult) {
  const SearchProblem problem = SmallProblem();
  for (const SearchAlgorithm algorithm : {SearchAlgorithm::kDirectL, SearchAlgorithm::kCrs2}) {
    GainSearchOptions options = SmallOptions();
    options.algorithm = algorithm;
    const GainSearchResult one = SearchGains(problem, options);
    options.jobs = 2;
    const GainSearchResult two = SearchGains(problem, options);
    ASSERT_EQ(one.seeds.size(), two.seeds.size());
    for (std::size_t i = 0; i < one.seeds.size(); ++i) {
      EXPECT_EQ(one.seeds[i].best.x, two.seeds[i].best.x);
      EXPECT_EQ(one.seeds[i].evaluations, two.seeds[i].evaluations);
    }
  }
}

TEST(GainSearch, TheHistoryOnlyImproves) {
  const GainSearchResult result = SearchGains(SmallProblem(), SmallOptions());
  for (const SeedResult& seed : result.seeds) {
    ASSERT_FALSE(seed.history.empty());
    for (std::size_t i = 1; i < seed.history.size(); ++i) {
      EXPECT_LT(seed.history[i].score, seed.history[i - 1].score);
      EXPECT_GT(seed.history[i].evaluation, seed.history[i - 1].evaluation);
    }
    EXPECT_EQ(seed.history.back().score, seed.best.score);
  }
}

TEST(GainSearch, TheSpectralRadiusIsSearchedToo) {
  const GainSearchResult result =
      SearchGains(SmallProblem(SearchObjective::kSpectralRadius), SmallOptions());
  EXPECT_EQ(result.best.verdict, PointVerdict::kGood);
  EXPECT_EQ(result.best.objective, result.best.spectral_radius);
  EXPECT_LT(result.best.spectral_radius, 0.7);
}

TEST(GainSearch, AStopKeepsWhatWasFound) {
  std::atomic<bool> stop{false};
  GainSearchOptions options = SmallOptions();
  options.seeds = 1;
  options.stop = &stop;
  options.progress = [&](int, int evaluation, const SearchPoint&) { stop = evaluation >= 10; };
  const GainSearchResult result = SearchGains(SmallProblem(), options);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.evaluations, 10);
  EXPECT_EQ(result.best.x.size(), 2u);
}

TEST(SearchPoint, AFailedRunIsAnOutcomeWithAName) {
  const SearchProblem problem = GainProblem();
  const std::vector<double> falls = {60.0, 0.5};
  const SearchPoint point = EvaluatePoint(problem, falls);
  EXPECT_EQ(point.verdict, PointVerdict::kRunEnded);
  EXPECT_FALSE(IsComplete(point.outcome));
  EXPECT_TRUE(std::isnan(point.objective));
  EXPECT_GE(point.score, 4.0);
}

TEST(SearchPoint, EveryVerdictScoresAboveTheBetterOnes) {
  SearchProblem problem = GainProblem();
  const std::vector<double> good = {25.0, 8.0};
  const SearchPoint free = EvaluatePoint(problem, good);
  ASSERT_EQ(free.verdict, PointVerdict::kGood);
  EXPECT_LT(free.score, 1.0);
  problem.constraints.max_torque = 0.01;
  const SearchPoint bound = EvaluatePoint(problem, good);
  EXPECT_EQ(bound.verdict, PointVerdict::kConstraint);
  EXPECT_EQ(bound.violated, "max_torque");
  EXPECT_GT(bound.torque, 0.01);
  EXPECT_GT(bound.score, 2.0);
  EXPECT_LT(bound.score, 3.0);
  EXPECT_EQ(bound.convergence.time, free.convergence.time) << "sampling changes nothing";
}

TEST(SearchPoint, TheTorqueLimitIsSeenInTheTorque) {
  SearchProblem problem = GainProblem();
  problem.constraints.max_torque = 100.0;
  const std::vector<double> x = {25.0, 8.0};
  const double free = EvaluatePoint(problem, x).torque;
  problem.hopper_at = [inner = problem.hopper_at, free](std::span<const double> at) {
    Hopper hopper = inner(at);
    hopper.request.parameters.torque_limit = 0.5 * free;
    return hopper;
  };
  EXPECT_NEAR(EvaluatePoint(problem, x).torque, 0.5 * free, 1e-9);
}

// Where the first landing of a run is, a steady hop does not know.
TEST(SearchPoint, TheSteadyHopThatIsMeasuredLandsAsEveryHop) {
  SearchProblem problem = GainProblem(SearchObjective::kSpectralRadius);
  problem.constraints.max_torque = 100.0;
  const std::vector<double> x = {25.0, 8.0};
  const double torque = EvaluatePoint(problem, x).torque;
  ASSERT_GT(torque, 0.0);
  problem.hopper_at = [inner = problem.hopper_at](std::span<const double> at) {
    Hopper hopper = inner(at);
    hopper.request.parameters.start_angle = testing::Degrees(40.0);
    return hopper;
  };
  EXPECT_EQ(EvaluatePoint(problem, x).torque, torque);
}

TEST(Robustness, CountsRunsAndKeepsTheWorst) {
  const SearchProblem problem = SmallProblem();
  const std::vector<double> x = {25.0, 8.0};
  const Hopper hopper = problem.hopper_at(x);
  RobustnessOptions options;
  options.noise_runs = 4;
  const Robustness one = AssessRobustness(hopper, options);
  EXPECT_EQ(one.stiffness.runs, 11);
  EXPECT_EQ(one.initial_states.runs, 25);
  EXPECT_GT(one.stiffness.converged, 0);
  const double own = EvaluatePoint(problem, x).convergence.time;
  EXPECT_GE(one.stiffness.worst_time, own);
  EXPECT_GT(one.noise.speed_deviation, 0.0);
  options.jobs = 2;
  EXPECT_EQ(AssessRobustness(hopper, options).noise.speed_deviation, one.noise.speed_deviation);
  options.touchdown_noise = 0.0;
  EXPECT_LT(AssessRobustness(hopper, options).noise.speed_deviation, 1e-3);
}

}  // namespace
}  // namespace hoplab
