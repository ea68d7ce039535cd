// Recovery of known values from generated traces: bias and coverage of the intervals.
// ctest -L statistics; the seeds are the trial numbers.

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdio>
#include <thread>

#include "base/parallel.h"
#include "fitting/uncertainty.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab {
namespace {

using testing::HopDataset;
using testing::HopTruth;

struct Recovered {
  double E, d;
  bool E_covered, d_covered, converged;
  double chi2_per_dof;
};

Recovered Recover(std::uint64_t seed, const HopTruth& truth) {
  const FitProblem problem = [&] {
    Dataset dataset = HopDataset(3, seed, truth);
    // A fit does not begin at the truth.
    for (Trial& t : dataset.trials) {
      t.mechanism.c_leg.E_Pa = 20e9;
      t.mechanism.c_leg.damping_N_s_per_m = 1.0;
    }
    return MakeProblem(dataset, {});
  }();
  const FitResult fit = Fit(problem, {});
  const Uncertainty u = AssessUncertainty(problem, TrialsOf(problem, TrialRole::kTrain), fit.shared,
                                          fit.initial_states, {}, 1);
  const auto covers = [&](int k, double value) {
    return u.parameters[k].ci95->first <= value && value <= u.parameters[k].ci95->second;
  };
  return {fit.shared[0],
          fit.shared[1],
          covers(0, truth.E_Pa),
          covers(1, truth.damping_N_s_per_m),
          fit.records[0].status == SolveStatus::kConverged,
          u.chi2_per_dof};
}

TEST(RecoveryStatistics, ValuesAreUnbiasedAndIntervalsCoverTheTruth) {
  constexpr int kSeeds = 100;
  const HopTruth truth;
  std::vector<Recovered> runs(kSeeds);
  ParallelFor(kSeeds, static_cast<int>(std::thread::hardware_concurrency()),
              [&](int i) { runs[i] = Recover(static_cast<std::uint64_t>(i) + 1, truth); });
  double E = 0, d = 0, chi2 = 0;
  int E_covered = 0, d_covered = 0, converged = 0;
  for (const Recovered& r : runs) {
    E += r.E / kSeeds;
    d += r.d / kSeeds;
    chi2 += r.chi2_per_dof / kSeeds;
    E_covered += r.E_covered;
    d_covered += r.d_covered;
    converged += r.converged;
  }
  double E_variance = 0, d_variance = 0;
  for (const Recovered& r : runs) {
    E_variance += (r.E - E) * (r.E - E) / (kSeeds - 1);
    d_variance += (r.d - d) * (r.d - d) / (kSeeds - 1);
  }
  std::printf("recovery, %d seeds, 3 hops, 6 trials, 1 mm noise\n", kSeeds);
  std::printf("  E: bias %+.4f %%, scatter %.4f %%, covered %d %%\n", 100 * (E / truth.E_Pa - 1),
              100 * std::sqrt(E_variance) / truth.E_Pa, E_covered);
  std::printf("  d: bias %+.4f %%, scatter %.4f %%, covered %d %%\n",
              100 * (d / truth.damping_N_s_per_m - 1),
              100 * std::sqrt(d_variance) / truth.damping_N_s_per_m, d_covered);
  std::printf("  chi2 per degree of freedom %.4f, converged %d of %d\n", chi2, converged, kSeeds);
  EXPECT_EQ(converged, kSeeds);
  EXPECT_LT(std::abs(E / truth.E_Pa - 1), 0.002);
  EXPECT_GE(E_covered, 90);
  EXPECT_LE(E_covered, 99);
  EXPECT_GE(d_covered, 90);
  EXPECT_LE(d_covered, 99);
  EXPECT_NEAR(chi2, 1.0, 0.01);
}

}  // namespace
}  // namespace hoplab
