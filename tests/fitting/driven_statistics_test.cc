// A hopper with a logged torque ripple and its own angle at each touch-down, noise on both: the
// modulus is found and its interval covers it. ctest -L statistics; the seeds are the trial
// numbers.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <thread>

#include "base/parallel.h"
#include "fitting/fit.h"
#include "fitting/uncertainty.h"
#include "tests/support/driven_hops.h"

namespace hoplab {
namespace {

TEST(DrivenStatistics, ModulusIsFoundAndCoveredWithNoiseOnTorqueAndAngles) {
  constexpr int kSeeds = 40;
  for (const bool held : {false, true}) {
    testing::DrivenHops hops;
    hops.held = held;
    struct Found {
      double E = 0.0;
      bool covered = false, converged = false;
    };
    std::vector<Found> found(kSeeds);
    ParallelFor(kSeeds, static_cast<int>(std::thread::hardware_concurrency()), [&](int i) {
      const FitProblem problem =
          MakeProblem(testing::DrivenDataset(hops, static_cast<std::uint64_t>(i) + 1), {});
      const FitResult fit = Fit(problem, {});
      const Uncertainty u = AssessUncertainty(problem, TrialsOf(problem, TrialRole::kTrain),
                                              fit.shared, fit.initial_states, {}, 1);
      const auto& ci = u.parameters[0].ci95;
      found[static_cast<std::size_t>(i)] = {
          fit.shared[0], ci && ci->first <= hops.truth.E_Pa && hops.truth.E_Pa <= ci->second,
          fit.records[0].status == SolveStatus::kConverged};
    });
    double mean = 0.0, worst = 0.0;
    int covered = 0, converged = 0;
    for (const Found& f : found) {
      const double off = f.E / hops.truth.E_Pa - 1.0;
      mean += off / kSeeds;
      worst = std::max(worst, std::abs(off));
      covered += f.covered;
      converged += f.converged;
    }
    std::printf(
        "driven hops, %s torque, %d seeds: E off by %+.3f %% on average, %.3f %% at most; "
        "covered %d; converged %d\n",
        held ? "held" : "linear", kSeeds, 100.0 * mean, 100.0 * worst, covered, converged);
    EXPECT_EQ(converged, kSeeds);
    EXPECT_LT(worst, 0.01);
    // 95 % of 40 with a binomial scatter of 1.4: four standard deviations below.
    EXPECT_GE(covered, 33);
  }
}

}  // namespace
}  // namespace hoplab
