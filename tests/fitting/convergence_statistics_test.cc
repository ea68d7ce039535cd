// How far off a fit may start: 40 starts from E x 0.5 to x 2 and d from 0 to x 3, each strategy,
// three-hop and ten-hop traces. The default must lead to the same optimum.
// ctest -L statistics

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <thread>

#include "base/parallel.h"
#include "base/random.h"
#include "fitting/fit.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab {
namespace {

using testing::HopDataset;

constexpr int kRestarts = 40;

struct Convergence {
  double share;    // of the restarts that end at the optimum
  double seconds;  // mean per start
};

// An end counts as the optimum if its cost is within a tenth of a standard error of the best.
Convergence ShareAtOptimum(int hops, FitStrategy strategy) {
  const FitProblem problem = MakeProblem(HopDataset(hops, 7), {});
  const std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  FitOptions options;
  options.strategy = strategy;
  // The optimum, from the truth: cost is half chi-square, so 0.005 is a tenth of a sigma.
  const StartRecord reference =
      FitFrom(problem, trials, Eigen::Vector2d(22e9, 3.0), options, 0, nullptr);
  std::vector<double> costs(kRestarts), seconds(kRestarts);
  ParallelFor(kRestarts, static_cast<int>(std::thread::hardware_concurrency()), [&](int i) {
    RandomStream random(20, static_cast<std::uint64_t>(i));
    const double E = 22e9 * std::pow(2.0, random.Uniform(-1.0, 1.0));
    const double d = 3.0 * random.Uniform(0.0, 3.0);
    const auto begin = std::chrono::steady_clock::now();
    costs[i] = FitFrom(problem, trials, Eigen::Vector2d(E, d), options, i, nullptr).cost;
    seconds[i] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  });
  int reached = 0;
  for (double cost : costs) reached += std::abs(cost - reference.cost) < 0.005;
  const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  return {static_cast<double>(reached) / kRestarts, total / kRestarts};
}

class ConvergenceStatistics : public ::testing::TestWithParam<int> {};

TEST_P(ConvergenceStatistics, DefaultOptionsReachTheSameOptimumFromFarOff) {
  const int hops = GetParam();
  const Convergence raw = ShareAtOptimum(hops, FitStrategy::kRaw);
  const Convergence growing = ShareAtOptimum(hops, FitStrategy::kGrowingHorizon);
  const Convergence apex = ShareAtOptimum(hops, FitStrategy::kApexShooting);
  std::printf("%2d hops, %d starts, share at the optimum (mean time per start):\n", hops,
              kRestarts);
  for (const auto& [name, result] :
       {std::pair{"raw", raw}, {"growing_horizon", growing}, {"apex_shooting", apex}})
    std::printf("  %-16s %5.1f %%  (%.2f s)\n", name, 100 * result.share, result.seconds);
  ASSERT_EQ(FitOptions{}.strategy, FitStrategy::kApexShooting);
  EXPECT_GE(apex.share, 0.95);
}

INSTANTIATE_TEST_SUITE_P(Hops, ConvergenceStatistics, ::testing::Values(3, 10));

}  // namespace
}  // namespace hoplab
