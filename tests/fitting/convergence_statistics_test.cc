// How far off a fit may start: 40 starts from E x 0.5 to x 2 and d from 0 to x 3, each strategy,
// three-hop and ten-hop traces. The default must lead to the same optimum.
// ctest -L statistics

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <thread>

#include "base/parallel.h"
#include "base/random.h"
#include "fitting/fit.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab {
namespace {

using testing::HopDataset;

constexpr int kStarts = 40;

// Share of the starts that end within a tenth of a standard error's cost of the best optimum.
double ShareAtOptimum(int hops, FitStrategy strategy) {
  const FitProblem problem = MakeProblem(HopDataset(hops, 7), {});
  const std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  FitOptions options;
  options.strategy = strategy;
  // The optimum, from the truth: cost is half chi-square, so 0.005 is a tenth of a sigma.
  const StartRecord reference =
      FitFrom(problem, trials, Eigen::Vector2d(22e9, 3.0), options, 0, nullptr);
  std::vector<double> costs(kStarts);
  ParallelFor(kStarts, static_cast<int>(std::thread::hardware_concurrency()), [&](int i) {
    RandomStream random(20, static_cast<std::uint64_t>(i));
    const double E = 22e9 * std::pow(2.0, random.Uniform(-1.0, 1.0));
    const double d = 3.0 * random.Uniform(0.0, 3.0);
    costs[i] = FitFrom(problem, trials, Eigen::Vector2d(E, d), options, i, nullptr).cost;
  });
  int reached = 0;
  for (double cost : costs) reached += std::abs(cost - reference.cost) < 0.005;
  return static_cast<double>(reached) / kStarts;
}

class ConvergenceStatistics : public ::testing::TestWithParam<int> {};

TEST_P(ConvergenceStatistics, DefaultOptionsReachTheSameOptimumFromFarOff) {
  const int hops = GetParam();
  const double raw = ShareAtOptimum(hops, FitStrategy::kRaw);
  const double growing = ShareAtOptimum(hops, FitStrategy::kGrowingHorizon);
  const double apex = ShareAtOptimum(hops, FitStrategy::kApexShooting);
  std::printf("%2d hops, %d starts at the optimum: raw %.1f %%, growing_horizon %.1f %%, "
              "apex_shooting %.1f %%\n",
              hops, kStarts, 100 * raw, 100 * growing, 100 * apex);
  ASSERT_EQ(FitOptions{}.strategy, FitStrategy::kApexShooting);
  EXPECT_GE(apex, 0.95);
}

INSTANTIATE_TEST_SUITE_P(Hops, ConvergenceStatistics, ::testing::Values(3, 10));

}  // namespace
}  // namespace hoplab
