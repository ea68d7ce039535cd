#include "fitting/diagnosis/other_models.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <random>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;

// A linear told model: y = S a + t b + noise of 1, fitted without b. Two fitted values, of scales 1
// and 10, one candidate.
struct LinearCase {
  Eigen::MatrixXd S;
  Eigen::VectorXd t, r;  // r: residual of the data at the values given, simulated less measured
  Candidate candidate = CandidateOf("gravity_scale");
  Naming naming;
  Linearisation at;

  // `gain`: nats that b = `size` gains, about.
  LinearCase(double size, double gain) {
    constexpr int kRows = 60;
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto draw = [&] { return normal(random); };
    S = Eigen::MatrixXd::NullaryExpr(kRows, 2, draw);
    t = Eigen::VectorXd::NullaryExpr(kRows, draw) + S.col(0);
    t *= std::sqrt(2.0 * gain) / (size * std::sqrt(static_cast<double>(kRows)));
    r = Eigen::VectorXd::NullaryExpr(kRows, draw) - size * t;
    LinearisedTrial trial;
    trial.raw = trial.r = r;
    trial.fitted = S;
    trial.tested = t;
    trial.tested_square = trial.tested.colwise().squaredNorm();
    trial.leverage = Eigen::VectorXd::Zero(kRows);
    trial.labels.resize(kRows);
    trial.row_count = trial.samples = kRows;
    at = Assemble({trial}, 2, 1);

    FittedModel& told = naming.best;
    told.problem.shared.resize(2);
    told.problem.shared[0].name = "a0";
    told.problem.shared[1].name = "a1";
    told.problem.shared[0].scale = 1.0;
    told.problem.shared[1].scale = 10.0;
    for (SharedParameter& s : told.problem.shared) {
      s.lower = -1e6;
      s.upper = 1e6;
    }
    told.shared = Eigen::Vector2d(100.0, 200.0);
    naming.candidates.resize(1);
    naming.candidates[0].candidate = candidate;
    naming.log_odds = 3.0;
  }
  std::vector<OtherModel> Others() const { return OtherModelsOf(naming, at, {&candidate, 1}); }
};

TEST(OtherModels, OneCauseMoreMovesTheFittedValuesAsAFitOfAllAtOnce) {
  const LinearCase c(0.01, 40.0);
  const auto others = c.Others();
  ASSERT_EQ(others.size(), 1u);
  Eigen::MatrixXd all(c.S.rows(), 3);
  all << c.S, c.t;
  const Eigen::VectorXd together = -all.householderQr().solve(c.r);
  const Eigen::VectorXd alone = -c.S.householderQr().solve(c.r);
  EXPECT_NEAR(others[0].size[0], together[2], 1e-12);
  EXPECT_NEAR(others[0].moved[0], together[0] - alone[0], 1e-10);
  EXPECT_NEAR(others[0].moved[1], 10.0 * (together[1] - alone[1]), 1e-9);
  // What the cause adds to the variance of a value.
  const Eigen::MatrixXd more = (all.transpose() * all).inverse();
  const Eigen::MatrixXd less = (c.S.transpose() * c.S).inverse();
  EXPECT_NEAR(std::pow(others[0].spread[0], 2), more(0, 0) - less(0, 0), 1e-10);
  EXPECT_NEAR(std::pow(others[0].spread[1] / 10.0, 2), more(1, 1) - less(1, 1), 1e-10);
}

TEST(OtherModels, OddsAreTheIntegralOfTheLikelihoodOverTheSize) {
  const LinearCase c(0.01, 12.0);
  const auto others = c.Others();
  ASSERT_EQ(others.size(), 1u);
  const EffectParameter& p = c.candidate.Parameter(0);
  const Eigen::VectorXd column = c.at.columns.col(0), left = c.at.r;
  const auto density = [&](double size) {
    const double cost = 0.5 * ((left + size * column).squaredNorm() - left.squaredNorm());
    return std::exp(-cost + LogSizePrior(size / p.typical, false)) / p.typical;
  };
  const double middle = others[0].size[0], width = 8.0 / column.norm();
  const double integral = boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
      density, middle - width, middle + width);
  // Laplace takes the prior as level over what the data leave.
  EXPECT_NEAR(others[0].log_odds, std::log(integral) - c.naming.log_odds, 0.1);
}

TEST(OtherModels, WhatTheDataRuleOutIsNotAmongThem) {
  EXPECT_TRUE(LinearCase(0.01, 0.5).Others().empty());
  // More gravity than the catalogue allows is no model.
  EXPECT_TRUE(LinearCase(50.0, 200.0).Others().empty());
}

// Gravity off by 0.02 +- 0.008, a typical size is 0.005: its odds alone would not rule it out.
TEST(OtherModels, WhatTheDataCannotShowIsNotAmongThem) {
  EXPECT_TRUE(LinearCase(0.02, 3.0).Others().empty());
  EXPECT_FALSE(LinearCase(0.005, 6.0).Others().empty());
}

TEST(OtherModels, IntervalsHoldThemAndAreCutAtTheBounds) {
  LinearCase c(0.01, 40.0);
  c.naming.best.problem.shared[0].upper = 103.5;
  OtherModel other;
  other.moved = Eigen::Vector2d(3.0, -2.0);
  other.spread = Eigen::Vector2d(0.0, 3.0);
  Uncertainty u;
  u.parameters.resize(2);
  u.parameters[0].std_error = 1.0;
  u.parameters[0].ci95 = {98.0, 102.0};
  u.parameters[0].ci95_between_trials = {90.0, 110.0};
  u.parameters[1].std_error = 4.0;
  u.parameters[1].ci95 = {192.0, 208.0};
  other.log_odds = 40.0;  // as good as certain
  HoldOtherModels({&other, 1}, c.naming.best, u);
  EXPECT_EQ(u.parameters[0].ci95, std::make_pair(98.0, 103.5));
  EXPECT_EQ(u.parameters[0].ci95_given_model, std::make_pair(98.0, 102.0));
  EXPECT_EQ(u.parameters[0].ci95_between_trials->first, 90.0);
  EXPECT_NEAR(u.parameters[1].ci95->first, 198.0 - 1.959963984540054 * 5.0, 1e-12);
  EXPECT_EQ(u.parameters[1].ci95->second, 208.0);
  EXPECT_FALSE(u.parameters[1].ci95_between_trials);
}

TEST(OtherModels, AnIntervalLeavesTwoAndAHalfPerCentOfBothModelsPastItsEnd) {
  const LinearCase c(0.01, 40.0);
  for (const double log_odds : {-2.9, -1.0, 0.0, 3.0}) {
    OtherModel other;
    other.log_odds = log_odds;
    other.moved = Eigen::Vector2d(6.0, 0.0);
    other.spread = Eigen::Vector2d(1.0, 0.0);
    Uncertainty u;
    u.parameters.resize(2);
    u.parameters[0].std_error = 1.0;
    u.parameters[0].ci95 = {98.04, 101.96};
    HoldOtherModels({&other, 1}, c.naming.best, u);
    const double end = u.parameters[0].ci95->second;
    EXPECT_EQ(u.parameters[0].ci95->first, 98.04);
    EXPECT_GE(end, 106.0);
    const auto beyond = [](double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); };
    const double odds = std::exp(log_odds);
    // The told model has nothing there that counts.
    EXPECT_NEAR(
        (beyond(end - 100.0) + odds * beyond((end - 106.0) / std::sqrt(2.0))) / (1.0 + odds), 0.025,
        1e-8);
  }
}

}  // namespace
}  // namespace hoplab
