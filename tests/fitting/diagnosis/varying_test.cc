#include "fitting/diagnosis/varying.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fitting/deviation.h"
#include "fitting/diagnosis/diagnosis.h"
#include "fitting/diagnosis/heterogeneity.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::HopsWithDrag;
using testing::NullFit;

constexpr double kSigma = testing::kDragHopsSigma;

// A fixed sample of N(mu, tau^2) truncated at nothing: quantiles in an order that has no trend.
std::vector<double> DrawnSizes(double mu, double tau) {
  const std::vector<double> normal = {0.32,  -1.38, 0.67, -0.32, 1.38,
                                      -0.67, 0.10,  1.0,  -1.0,  -0.10};
  std::vector<double> sizes;
  for (const double z : normal) sizes.push_back(mu + tau * z);
  return sizes;
}

FittedModel WithDrag(const NullFit& fit, const RefitSettings& settings) {
  FittedModel model = Refit(fit.null, std::array{CandidateOf("air_drag")},
                            Eigen::VectorXd::Constant(1, 0.05), settings);
  Settle(model, settings);
  return model;
}
int DragOf(const FittedModel& model) { return model.problem.shared_count() - 1; }

// Restricted likelihood, mean and sizes of one random effect by dense matrices: y = X b + c u + e,
// u ~ N(0, tau^2) of each trial, e ~ N(0, 1), b flat (Patterson and Thompson 1971; Robinson 1991).
class DenseMixedModel {
 public:
  // The rows of trials with their deviation taken back; X: the shared values, but for what is held,
  // then the initial states.
  DenseMixedModel(const VaryingModel& v, int place) : place_(place) {
    const int n = v.model.problem.shared_count();
    Eigen::Index rows = 0, columns = n;
    std::vector<TrialEvaluation> evaluations(v.train.size());
    for (std::size_t i = 0; i < v.train.size(); ++i) {
      TrialEvaluator(v.model.problem, v.train[i])
          .Evaluate({v.model.shared, v.model.initial_states[i], true}, evaluations[i]);
      rows += evaluations[i].residuals.size();
      columns += v.train[i].own_count() - 1;
    }
    X_ = Eigen::MatrixXd::Zero(rows, columns);
    Z_ = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(v.train.size()));
    y_.resize(rows);
    Eigen::Index row = 0, column = n;
    for (std::size_t i = 0; i < v.train.size(); ++i) {
      const TrialEvaluation& e = evaluations[i];
      const Eigen::Index m = e.residuals.size();
      const int own = *DeviationOf(place, v.train[i]);
      const Eigen::VectorXd c = e.jacobian.col(n + own);
      y_.segment(row, m) = -(e.residuals - c * v.model.initial_states[i][own]);
      X_.block(row, 0, m, n) = e.jacobian.leftCols(n);
      for (int k = 0; k < v.train[i].own_count(); ++k)
        if (k != own) X_.block(row, column++, m, 1) = e.jacobian.col(n + k);
      Z_.block(row, static_cast<Eigen::Index>(i), m, 1) = c;
      // The deviation's own prior is the random effect's: its row is none of the data.
      Eigen::Index prior = m - 1;
      while (e.jacobian(prior, n + own) == 0.0 ||
             e.jacobian.row(prior).norm() != e.jacobian(prior, n + own))
        --prior;
      y_[row + prior] = 0.0;
      Z_(row + prior, static_cast<Eigen::Index>(i)) = 0.0;
      row += m;
    }
    if (v.model.problem.shared[static_cast<std::size_t>(place)].held) {
      const Eigen::Index after = X_.cols() - place - 1;
      const Eigen::MatrixXd right = X_.rightCols(after);
      X_.middleCols(place, after) = right;
      X_.conservativeResize(Eigen::NoChange, X_.cols() - 1);
    }
    // Columns of very different units: the likelihood's constant changes, its maximum does not.
    scale_ = X_.colwise().norm();
    X_ = X_ * scale_.cwiseInverse().asDiagonal();
  }
  double LogLikelihood(double tau) {
    const Eigen::Index rows = y_.size();
    const Eigen::MatrixXd V =
        Eigen::MatrixXd::Identity(rows, rows) + tau * tau * Z_ * Z_.transpose();
    const Eigen::LLT<Eigen::MatrixXd> llt(V);
    const Eigen::MatrixXd ViX = llt.solve(X_);
    const Eigen::MatrixXd H = X_.transpose() * ViX;
    const Eigen::LLT<Eigen::MatrixXd> of_h(H);
    b_ = of_h.solve(ViX.transpose() * y_);
    const Eigen::VectorXd Viy = llt.solve(y_ - X_ * b_);
    u_ = tau * tau * Z_.transpose() * Viy;
    const Eigen::MatrixXd L = llt.matrixL(), Lh = of_h.matrixL();
    return -L.diagonal().array().log().sum() - Lh.diagonal().array().log().sum() -
           0.5 * (y_ - X_ * b_).dot(Viy);
  }
  double Step() const { return b_[place_] / scale_[place_]; }
  const Eigen::VectorXd& sizes() const { return u_; }
  // Golden section on the logarithm.
  double BestTau(double low, double high) {
    double a = std::log(low), b = std::log(high);
    const double g = 0.5 * (std::sqrt(5.0) - 1.0);
    for (int i = 0; i < 25; ++i) {
      const double c = b - g * (b - a), d = a + g * (b - a);
      (LogLikelihood(std::exp(c)) > LogLikelihood(std::exp(d)) ? b : a) =
          LogLikelihood(std::exp(c)) > LogLikelihood(std::exp(d)) ? d : c;
    }
    return std::exp(0.5 * (a + b));
  }

 private:
  int place_;
  Eigen::MatrixXd X_, Z_;
  Eigen::VectorXd y_, b_, u_, scale_;
};

TEST(RefitVarying, AgreesWithADenseMixedModelAtTheRefit) {
  const std::vector<double> sizes = {0.05, 0.09, 0.03, 0.07, 0.06};
  const NullFit fit(HopsWithDrag(sizes, {}, 3));
  const RefitSettings white = fit.SettingsOf(Discrepancy::kNone);
  const FittedModel model = WithDrag(fit, white);
  ASSERT_TRUE(model.ok());
  const VaryingModel v = RefitVarying(model, {DragOf(model)}, white);
  ASSERT_TRUE(v.converged);
  ASSERT_EQ(v.values.size(), 1u);
  const int place = DragOf(model);
  DenseMixedModel dense(v, place);
  const double tau = dense.BestTau(0.2 * v.values[0].spread, 5.0 * v.values[0].spread);
  EXPECT_NEAR(v.values[0].spread, tau, 0.01 * tau);
  const double there = dense.LogLikelihood(tau);
  // The linear prediction of the program is that of the dense model; so is the gain.
  const Heterogeneity h = HeterogeneityAt(v.model, v.train, place, 1);
  EXPECT_NEAR(h.spread, tau, 1e-3 * tau);
  EXPECT_NEAR(h.gain, there - dense.LogLikelihood(1e-9), 1e-2);
  dense.LogLikelihood(tau);
  const double mean = v.model.shared[place] + dense.Step();
  EXPECT_NEAR(h.mean, mean, 1e-3 * tau);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double expected = mean + dense.sizes()[static_cast<Eigen::Index>(i)];
    EXPECT_NEAR(h.sizes[i], expected, 1e-3 * tau) << i;
    // The solver found the same, by another way.
    EXPECT_NEAR(v.values[0].sizes[i], expected, 0.02 * tau) << i;
  }
  EXPECT_NEAR(v.values[0].mean, mean, 0.02 * tau);
}

// A mean that is held is no unknown.
TEST(RefitVarying, AgreesWithADenseMixedModelWhereTheMeanIsHeld) {
  const NullFit fit(HopsWithDrag({0.05, 0.09, 0.03, 0.07, 0.06}, {}, 3));
  const RefitSettings white = fit.SettingsOf(Discrepancy::kNone);
  Candidate drag = CandidateOf("air_drag");
  drag.mean_held = true;
  FittedModel model = Refit(fit.null, std::array{drag}, Eigen::VectorXd::Constant(1, 0.06), white);
  model.shared.tail(1).setConstant(0.06);
  model.cost = std::numeric_limits<double>::infinity();
  Settle(model, white);
  ASSERT_TRUE(model.ok());
  const int place = DragOf(model);
  EXPECT_EQ(model.shared[place], 0.06);
  const VaryingModel v = RefitVarying(model, {place}, white);
  ASSERT_TRUE(v.converged);
  ASSERT_EQ(v.values.size(), 1u);
  EXPECT_EQ(v.values[0].mean, 0.06);
  EXPECT_FALSE(v.values[0].ci95);
  DenseMixedModel dense(v, place);
  const double tau = dense.BestTau(0.2 * v.values[0].spread, 5.0 * v.values[0].spread);
  const Heterogeneity h = HeterogeneityAt(v.model, v.train, place, 1);
  EXPECT_NEAR(h.spread, tau, 1e-3 * tau);
  EXPECT_NEAR(h.gain, dense.LogLikelihood(tau) - dense.LogLikelihood(1e-9), 1e-2);
  dense.LogLikelihood(tau);
  EXPECT_EQ(h.mean, 0.06);
  for (std::size_t i = 0; i < h.sizes.size(); ++i) {
    EXPECT_NEAR(h.sizes[i], 0.06 + dense.sizes()[static_cast<Eigen::Index>(i)], 1e-3 * tau) << i;
    EXPECT_NEAR(v.values[0].sizes[i], h.sizes[i], 0.02 * tau) << i;
  }
}

// Sizes that do not differ are told to vary in one of a hundred cases, and then have to pay.
TEST(RefitVarying, FindsNothingWhereSizesDoNotDiffer) {
  int told = 0, differ = 0;
  constexpr int kSeeds = 20;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const NullFit fit(
        HopsWithDrag(std::vector<double>(5, 0.06), {}, static_cast<std::uint64_t>(seed)));
    const FittedModel model = WithDrag(fit, fit.Settings());
    ASSERT_TRUE(model.ok());
    differ += Differs(HeterogeneityOf(model, fit.train, 1).back());
    const VaryingModel v = RefitVarying(model, {DragOf(model)}, fit.Settings());
    EXPECT_TRUE(v.converged) << seed;
    told += v.gain >= kVaryingPays;
  }
  EXPECT_LE(differ, 1);
  EXPECT_EQ(told, 0);
}

TEST(RefitVarying, KeepsEverySizeWithinTheBounds) {
  const NullFit fit(HopsWithDrag({0.0, 0.06, 0.0, 0.12, 0.03, 0.0}, {}, 4));
  const FittedModel model = WithDrag(fit, fit.Settings());
  ASSERT_TRUE(model.ok());
  const VaryingModel v = RefitVarying(model, {DragOf(model)}, fit.Settings());
  ASSERT_TRUE(v.converged);
  ASSERT_EQ(v.values.size(), 1u);
  for (std::size_t i = 0; i < v.train.size(); ++i) {
    EXPECT_GE(v.values[0].sizes[i], 0.0) << i;
    const int own = *DeviationOf(DragOf(model), v.train[i]);
    EXPECT_GE(v.model.shared[DragOf(model)] + v.model.initial_states[i][own], -1e-12) << i;
  }
}

TEST(Diagnose, RecoversASizePerTrialItsMeanAndItsSpread) {
  constexpr double kMean = 0.06, kSpread = 0.02;
  const std::vector<double> sizes = DrawnSizes(kMean, kSpread);
  const Dataset dataset = HopsWithDrag(sizes, {0.03, 0.075, 0.095}, 7);
  const Diagnosis d =
      Diagnose(dataset, testing::OptionsWith({"air_drag", "gravity_scale", "sensor_delay"}));
  ASSERT_TRUE(d.extension) << d.reason;
  const ExtensionReport& e = *d.extension;
  ASSERT_FALSE(e.causes.empty());
  const CauseReport& drag = e.causes.front();
  ASSERT_EQ(drag.cause.effect->info.name, "air_drag");
  EXPECT_TRUE(drag.cause.each_trial);
  EXPECT_TRUE(e.TellsSizesOf(drag, 0));
  ASSERT_TRUE(drag.refitted.at(0));
  const VaryingValue& value = *drag.refitted[0];
  // Sampling errors of mean and spread of ten sizes: 0.32 and 0.24 of the spread.
  const double n = static_cast<double>(sizes.size());
  EXPECT_NEAR(value.mean, kMean, 2.0 * kSpread / std::sqrt(n));
  EXPECT_NEAR(value.spread, kSpread, 2.0 * kSpread / std::sqrt(2.0 * (n - 1.0)));
  ASSERT_TRUE(value.ci95);
  EXPECT_LT(value.ci95->first, kMean);
  EXPECT_GT(value.ci95->second, kMean);
  for (std::size_t i = 0; i < sizes.size(); ++i)
    EXPECT_NEAR(value.sizes[i], sizes[i], 3.0 * value.std_errors[i]) << i;
  // A size is told well enough for that to say something.
  EXPECT_LT(*std::max_element(value.std_errors.begin(), value.std_errors.end()), 0.6 * kSpread);
  // One size is much worse; a size in each trial leaves the noise.
  EXPECT_GT(d.naming.gaps.front(), 40.0);
  for (const double rmse : e.after.test.rmse) EXPECT_NEAR(rmse, kSigma, 0.15 * kSigma);
  EXPECT_GT(e.explained, 0.99);
}

}  // namespace
}  // namespace hoplab
