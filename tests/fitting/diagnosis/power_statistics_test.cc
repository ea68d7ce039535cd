// How often an effect's own score crosses a threshold, against what the linear model predicts.
// ctest -L statistics

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <map>
#include <thread>

#include "base/parallel.h"
#include "datasets/read_dataset.h"
#include "tests/fitting/diagnosis/study.h"
#include "tests/support/temp_folder.h"

namespace hoplab::testing {
namespace {

// Level of the one-candidate test whose threshold on one degree of freedom delta80 refers to.
double OwnLevel() {
  return boost::math::cdf(
      boost::math::complement(boost::math::chi_squared(1.0), kDelta80Threshold));
}

/// p-value of the planted effect's own score at the null fit, under white noise as the detection of
/// a diagnosis has it; NaN where that is not reached.
double OwnP(const Truth& truth) {
  const TempFolder temp;
  const SealedCase sealed(temp.path() / "case", truth);
  ProblemOptions options;
  options.law = std::string(NameOf(truth.law));
  FitOptions white;
  white.discrepancy = Discrepancy::kNone;
  const DatasetFit fit = FitTraces(MakeProblem(ReadDataset(sealed.dataset()), options), white);
  if (!fit.result.ok) return std::nan("");
  const std::array tested = {Candidate{FindEffect(sealed.Open().effects.front().name)}};
  const FitProblem problem = Extend(fit.problem, tested);
  Eigen::VectorXd shared(problem.shared_count());
  shared << fit.result.shared, NullValues(tested);
  const Linearisation at =
      Linearise(problem, fit.problem.shared_count(), TrialsOf(fit.problem, TrialRole::kTrain),
                shared, fit.result.initial_states, 1);
  return ScoreOf(at, HypothesesOf(tested).front()).p_value;
}

// Rate the linear model predicts at `size` delta80.
double Predicted(const Effect& effect, double size) {
  const double delta = size * (std::sqrt(kDelta80Threshold) + 0.8416212);
  const EffectParameter& p = effect.info.parameters[0];
  const auto dof = static_cast<double>(effect.info.parameters.size());
  if (dof == 1.0 && (p.lower >= p.null || p.upper <= p.null)) {
    const boost::math::normal normal;
    const double z = boost::math::quantile(boost::math::complement(normal, OwnLevel()));
    return boost::math::cdf(boost::math::complement(normal, z - delta));
  }
  const double threshold =
      boost::math::quantile(boost::math::complement(boost::math::chi_squared(dof), OwnLevel()));
  return boost::math::cdf(
      boost::math::complement(boost::math::non_central_chi_squared(dof, delta * delta), threshold));
}

TEST(DiagnosisStatistics, PowerGrowsWithSizeAsTheNoncentralChiSquarePredicts) {
  const int seeds = SeedCount(200);
  constexpr std::array kPowerSizes = {0.5, 1.0, 1.5, 2.0};
  Report report("2-power", "Power against size");
  report.Say(
      "Share of %d datasets on which the planted effect's own score is significant at the "
      "level of chi-square %.2f on one degree of freedom (p <= %.4f), in per cent; in "
      "brackets what the noncentral chi-square (a normal tail for one-sided effects) "
      "predicts. delta80 = 3.64/sqrt(V) at the true values. Laws take turns.",
      seeds, kDelta80Threshold, OwnLevel());
  report.Head({"effect", "0.5", "1", "1.5", "2 delta80", "largest difference"});
  std::map<std::string, std::array<int, 4>> hits;
  std::map<std::string, std::array<int, 4>> runs;
  for (std::size_t s = 0; s < kPowerSizes.size(); ++s) {
    const std::vector<Truth> truths = PlantEach(Table::kPower, kPowerSizes[s], seeds);
    std::vector<double> p(truths.size());
    ParallelFor(static_cast<int>(truths.size()),
                static_cast<int>(std::thread::hardware_concurrency()),
                [&](int i) { p[i] = OwnP(truths[i]); });
    for (std::size_t i = 0; i < truths.size(); ++i) {
      hits[truths[i].effects.front().name][s] += p[i] <= OwnLevel();
      ++runs[truths[i].effects.front().name][s];
    }
  }
  for (const auto& [name, counts] : hits) {
    std::vector<std::string> row = {name};
    double largest = 0.0, before = 0.0;
    for (std::size_t s = 0; s < kPowerSizes.size(); ++s) {
      const int n = runs[name][s];
      if (n == 0) {
        row.push_back("-");
        continue;
      }
      const double rate = static_cast<double>(counts[s]) / n;
      const double predicted = Predicted(*FindEffect(name), kPowerSizes[s]);
      // Within 10 points, and what chance may add at this number of seeds.
      const double chance = n < 200 ? 2.6 * std::sqrt(0.25 / n) : 0.0;
      EXPECT_NEAR(rate, predicted, 0.10 + chance) << name << " at " << kPowerSizes[s];
      EXPECT_GE(rate, before - 1.6 * chance) << name << " at " << kPowerSizes[s];
      before = rate;
      if (std::abs(rate - predicted) > std::abs(largest)) largest = rate - predicted;
      row.push_back(Cell("%.0f (%.0f)", 100.0 * rate, 100.0 * predicted));
    }
    row.push_back(Cell("%+.0f", 100.0 * largest));
    report.Row(row);
  }
}

}  // namespace
}  // namespace hoplab::testing
