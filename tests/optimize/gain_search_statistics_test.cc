// The gain search against a brute-force grid, seed by seed and algorithm by algorithm: the figures
// of docs/decisions/0004-gain-search.md. ctest -L statistics; the seeds are 1 to 10.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "tests/support/gain_problem.h"

namespace hoplab {
namespace {

using testing::GainProblem;

constexpr int kGrid = 100;
constexpr int kSeeds = 10;
constexpr int kBudget = 1000;  // a tenth of the grid's evaluations

int Jobs() { return static_cast<int>(std::thread::hardware_concurrency()); }

double BestOfGrid(const SearchProblem& problem) {
  const std::vector<double> at = {0.0, 0.0};
  double best = std::numeric_limits<double>::infinity();
  for (const MapCell& cell : MapObjective(problem, at, kGrid, Jobs()))
    best = std::min(best, cell.point.score);
  return best;
}

// Seeds of ten that are not worse than the grid; prints their spread.
int NotWorse(const SearchProblem& problem, double grid, SearchAlgorithm algorithm, double polish) {
  GainSearchOptions options;
  options.algorithm = algorithm;
  options.budget = kBudget;
  options.seeds = kSeeds;
  options.jobs = Jobs();
  options.polish_share = polish;
  const GainSearchResult result = SearchGains(problem, options);
  std::vector<double> scores;
  for (const SeedResult& seed : result.seeds) {
    EXPECT_LE(seed.evaluations, kBudget);
    scores.push_back(seed.best.score);
  }
  std::sort(scores.begin(), scores.end());
  const auto better =
      std::count_if(scores.begin(), scores.end(), [&](double score) { return score <= grid; });
  std::printf(
      "  %-16s polish %.1f: not worse %2td of %d; over the grid's best: best %.4f, median "
      "%.4f, worst %.4f\n",
      std::string(NameOf(algorithm)).c_str(), polish, better, kSeeds, scores.front() / grid,
      scores[kSeeds / 2] / grid, scores.back() / grid);
  return static_cast<int>(better);
}

class AgainstTheGrid : public ::testing::TestWithParam<SearchObjective> {};

TEST_P(AgainstTheGrid, TheDefaultSearchIsNotWorseFromAnySeed) {
  const SearchProblem problem = GainProblem(GetParam());
  const double grid = BestOfGrid(problem);
  std::printf("%s: best of %d x %d scores %.6f; %d evaluations a seed\n",
              std::string(NameOf(GetParam())).c_str(), kGrid, kGrid, grid, kBudget);
  const GainSearchOptions defaults;
  EXPECT_EQ(NotWorse(problem, grid, defaults.algorithm, defaults.polish_share), kSeeds);
}

// The table of 0004-gain-search.md, in ten minutes; asserts that each keeps to its budget.
TEST_P(AgainstTheGrid, EveryAlgorithmKeepsToItsBudgetWithAndWithoutPolishing) {
  const SearchProblem problem = GainProblem(GetParam());
  const double grid = BestOfGrid(problem);
  for (const std::string& name : SearchAlgorithmNames()) {
    for (const double polish : {0.0, 0.3})
      NotWorse(problem, grid, *FindSearchAlgorithm(name), polish);
  }
}

INSTANTIATE_TEST_SUITE_P(Objectives, AgainstTheGrid,
                         ::testing::Values(SearchObjective::kConvergenceTime,
                                           SearchObjective::kSpectralRadius),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

}  // namespace
}  // namespace hoplab
