#include "fitting/diagnosis/heterogeneity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::NullFit;

constexpr int kTrials = 6;
constexpr double kSigma = 2e-4;  // m

// Drops whose commanded angles are off by a size of their own each: what the data hold, since the
// angle told is moved and the traces are not.
FittedModel WithAngles(const std::vector<double>& off, std::vector<TrialProblem>& train) {
  Dataset dataset = testing::DatasetOf({.train = kTrials, .test = 0, .sigma_m = kSigma});
  for (std::size_t i = 0; i < off.size(); ++i) dataset.trials[i].touchdown_angle_rad -= off[i];
  const NullFit fit(dataset);
  train = fit.train;
  return Refit(fit.null, std::array{CandidateOf("touchdown_angle_bias")},
               Eigen::VectorXd::Constant(1, 0.01), fit.SettingsOf(Discrepancy::kNone));
}

TEST(HeterogeneityOf, FindsTheSizeOfEachTrialTheirMeanAndSpread) {
  const std::vector<double> off = {0.003, 0.010, 0.017, 0.006, 0.013, 0.011};
  const double mean = std::accumulate(off.begin(), off.end(), 0.0) / kTrials;
  double square = 0.0;
  for (const double b : off) square += (b - mean) * (b - mean);
  const double spread = std::sqrt(square / (kTrials - 1));
  std::vector<TrialProblem> train;
  const FittedModel model = WithAngles(off, train);
  ASSERT_TRUE(model.ok());
  const Heterogeneity h = HeterogeneityOf(model, train, 1).back();
  ASSERT_EQ(h.sizes.size(), off.size());
  // To first order around the mean: a tenth of the spread.
  for (std::size_t i = 0; i < off.size(); ++i)
    EXPECT_NEAR(h.sizes[i], off[i], 0.1 * spread) << train[i].file;
  EXPECT_NEAR(h.mean, mean, 0.1 * spread);
  EXPECT_NEAR(h.spread, spread, 0.15 * spread);
  EXPECT_LT(h.p_value, 1e-6);
  EXPECT_GT(h.gain, 10.0);
}

TEST(HeterogeneityOf, OfTrialsThatAgreeIsNone) {
  std::vector<TrialProblem> train;
  const FittedModel model = WithAngles(std::vector<double>(kTrials, 0.012), train);
  ASSERT_TRUE(model.ok());
  const Heterogeneity h = HeterogeneityOf(model, train, 1).back();
  EXPECT_GT(h.p_value, 0.01);
  EXPECT_LT(h.gain, 3.0);
  for (const double size : h.sizes) EXPECT_NEAR(size, 0.012, 0.003);
}

}  // namespace
}  // namespace hoplab
