#include "fitting/trial_evaluations.h"

#include <gtest/gtest.h>

#include "fitting/generate.h"
#include "tests/support/fit_cases.h"
#include "tests/support/robot_drops.h"

namespace hoplab {
namespace {

using testing::NominalInitialStates;
using testing::SmallDataset;

struct EvaluatedTrial {
  FitProblem problem = MakeProblem(SmallDataset(), {});
  std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  SolveRequest request;

  EvaluatedTrial() {
    request.problem = &problem;
    request.trials = &trials;
    request.shared = Eigen::Vector2d(21e9, 2.0);
    request.initial_states = NominalInitialStates(trials);
  }
};

// The oracle of costs: one trial after the other.
double CostOf(const EvaluatedTrial& c, const Eigen::VectorXd& shared) {
  double cost = 0.0;
  for (const TrialProblem& trial : c.trials) {
    TrialEvaluation e;
    TrialEvaluator(c.problem, trial).Evaluate({shared, trial.start}, e);
    cost += 0.5 * e.residuals.squaredNorm();
  }
  return cost;
}

TEST(TrialEvaluations, CostIsThatOfTheTrialsOneByOne) {
  const EvaluatedTrial c;
  TrialEvaluations at(c.request);
  at.PrepareForEvaluation(false, true);
  EXPECT_TRUE(at.IsComplete());
  EXPECT_NEAR(at.Cost() / CostOf(c, c.request.shared), 1.0, 1e-12);
}

TEST(TrialEvaluations, GradientIsTheSlopeOfTheCost) {
  const EvaluatedTrial c;
  TrialEvaluations at(c.request);
  at.PrepareForEvaluation(true, true);
  for (int k = 0; k < 2; ++k) {
    const double scale = c.problem.shared[static_cast<std::size_t>(k)].scale, h = 1e-5;
    Eigen::VectorXd plus = c.request.shared, minus = plus;
    plus[k] += h * scale;
    minus[k] -= h * scale;
    const double slope = (CostOf(c, plus) - CostOf(c, minus)) / (2.0 * h);
    EXPECT_NEAR(at.Gradient(k) / slope, 1.0, 1e-5);
  }
}

TEST(TrialEvaluations, BothKindsOfPointHaveTheSameSumOfSquares) {
  const EvaluatedTrial c;
  TrialEvaluations plain(c.request), differentiated(c.request);
  plain.PrepareForEvaluation(false, true);
  differentiated.PrepareForEvaluation(true, true);
  for (int i = 0; i < 2; ++i) {
    Eigen::VectorXd a(plain.RowCount(i)), b(differentiated.RowCount(i));
    plain.Copy(i, a.data(), nullptr, nullptr);
    differentiated.Copy(i, b.data(), nullptr, nullptr);
    EXPECT_NEAR(a.squaredNorm() / b.squaredNorm(), 1.0, 1e-8);  // two runs of the integrator
  }
}

TEST(TrialEvaluations, ComingBackToAPointKeepsItsDerivatives) {
  const EvaluatedTrial c;
  TrialEvaluations at(c.request);
  at.PrepareForEvaluation(true, true);
  const double cost = at.Cost(), gradient = at.Gradient(0);
  const double begin = at.shared()[0];
  at.shared()[0] = 1.05 * begin;
  at.PrepareForEvaluation(false, true);
  EXPECT_NE(at.Cost(), cost);
  EXPECT_NEAR(at.TriedShared()[0] / (1.05 * c.request.shared[0]), 1.0, 1e-14);
  EXPECT_EQ(at.Gradient(0), gradient);  // of the point with derivatives
  at.shared()[0] = begin;
  at.PrepareForEvaluation(true, true);
  EXPECT_EQ(at.Cost(), cost);
  EXPECT_EQ(at.Gradient(0), gradient);
}

TEST(TrialEvaluations, MovesToGivenValues) {
  const EvaluatedTrial c;
  TrialEvaluations at(c.request);
  std::vector<OwnValues> own = c.request.initial_states;
  own[1][0] += 0.01;
  at.MoveTo(Eigen::Vector2d(23e9, 1.0), own);
  EXPECT_NEAR(at.SharedValues()[0] / 23e9, 1.0, 1e-14);
  EXPECT_NEAR(at.OwnValuesOf(1)[0], own[1][0], 1e-14);
  EXPECT_EQ(at.OwnValuesOf(0), own[0]);
}

TEST(TrialEvaluations, AnEndBeforeTheDataIsCountedWithItsReason) {
  EvaluatedTrial c;
  c.request.shared[0] = 6e9;  // so soft that it sinks to the ground
  TrialEvaluations at(c.request);
  at.PrepareForEvaluation(false, true);
  EXPECT_FALSE(at.IsComplete());
  ASSERT_FALSE(at.rejected().empty());
  EXPECT_NE(at.rejected().begin()->first.find(".csv: "), std::string::npos);
}

// A robot's start has six values: with three shared ones the simulator would run once more for the
// columns of values that are held.
TEST(TrialEvaluations, HeldSharedValuesCostNoColumnsAndChangeNone) {
  const FitProblem problem = MakeProblem(GenerateDataset(testing::RobotDrops(), {}).dataset, {});
  ASSERT_EQ(problem.shared_count(), 3);
  const std::vector<TrialProblem> trials = {TrialsOf(problem, TrialRole::kTrain).front()};
  SolveRequest request;
  request.problem = &problem;
  request.trials = &trials;
  request.shared = InitialShared(problem);
  request.initial_states = NominalInitialStates(trials);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto own_of = [&](bool hold, Eigen::VectorXd& slopes) {
    request.hold_shared = hold;
    TrialEvaluations at(request);
    at.PrepareForEvaluation(true, true);
    Eigen::VectorXd residuals(at.RowCount(0));
    RowMajor own(at.RowCount(0), 6);
    at.Copy(0, residuals.data(), nullptr, own.data());
    slopes = own.transpose() * residuals;
    return Eigen::MatrixXd(own.transpose() * own);
  };
  Eigen::VectorXd all_slopes, own_slopes;
  const Eigen::MatrixXd all = own_of(false, all_slopes), own = own_of(true, own_slopes);
  ASSERT_GT(all.norm(), 0.0);
  EXPECT_LT((own - all).norm(), 1e-10 * all.norm());
  EXPECT_LT((own_slopes - all_slopes).norm(), 1e-10 * all_slopes.norm());
}

}  // namespace
}  // namespace hoplab
