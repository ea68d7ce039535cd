#include "fitting/trial_evaluations.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

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

// The oracle of costs: one trial after the other, with derivatives, which steer the steps.
double CostOf(const EvaluatedTrial& c, const Eigen::VectorXd& shared) {
  double cost = 0.0;
  for (const TrialProblem& trial : c.trials) {
    TrialEvaluation e;
    TrialEvaluator(c.problem, trial).Evaluate({shared, trial.start, true}, e);
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

// A search compares the cost of a point it tries with that of the point it is at: at one point both
// are one number, to the last bit.
TEST(TrialEvaluations, CostDoesNotDependOnWhetherDerivativesAreAskedFor) {
  const EvaluatedTrial c;
  TrialEvaluations tried(c.request), taken(c.request);
  tried.PrepareForEvaluation(false, true);
  taken.PrepareForEvaluation(true, true);
  EXPECT_EQ(tried.Cost(), taken.Cost());
  for (int i = 0; i < 2; ++i) {
    Eigen::VectorXd a(tried.RowCount(i)), b(taken.RowCount(i));
    tried.Copy(i, a.data(), nullptr, nullptr);
    taken.Copy(i, b.data(), nullptr, nullptr);
    EXPECT_EQ(a, b);
  }
}

// The oracle: the part of all residuals in the space of all columns, by one QR factorisation.
double GainOf(TrialEvaluations& at, const EvaluatedTrial& c, const std::vector<int>& shared) {
  const int n = c.problem.shared_count();
  std::vector<Eigen::MatrixXd> by_shared, by_own;
  std::vector<Eigen::VectorXd> residuals;
  Eigen::Index rows = 0, columns = static_cast<Eigen::Index>(shared.size());
  for (std::size_t i = 0; i < c.trials.size(); ++i) {
    const int own = c.trials[i].own_count(), count = at.RowCount(static_cast<int>(i));
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    RowMajor s(count, n), o(count, own);
    Eigen::VectorXd r(count);
    at.Copy(static_cast<int>(i), r.data(), s.data(), o.data());
    by_shared.emplace_back(s(Eigen::all, shared));
    by_own.emplace_back(o);
    residuals.push_back(r);
    rows += count;
    columns += own;
  }
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, columns);
  Eigen::VectorXd r(rows);
  Eigen::Index row = 0, column = static_cast<Eigen::Index>(shared.size());
  for (std::size_t i = 0; i < by_own.size(); ++i) {
    jacobian.block(row, 0, by_shared[i].rows(), by_shared[i].cols()) = by_shared[i];
    jacobian.block(row, column, by_own[i].rows(), by_own[i].cols()) = by_own[i];
    r.segment(row, residuals[i].size()) = residuals[i];
    row += residuals[i].size();
    column += by_own[i].cols();
  }
  const Eigen::VectorXd along = jacobian * jacobian.householderQr().solve(r);
  return 0.5 * along.squaredNorm();
}

TEST(TrialEvaluations, PredictedGainIsThatOfAllColumnsAtOnce) {
  const EvaluatedTrial c;
  TrialEvaluations at(c.request);
  at.PrepareForEvaluation(true, true);
  const double both = at.PredictedGain({}), damping = at.PredictedGain({0});
  EXPECT_GT(both, damping);
  EXPECT_NEAR(both / GainOf(at, c, {0, 1}), 1.0, 1e-7);
  EXPECT_NEAR(damping / GainOf(at, c, {1}), 1.0, 1e-7);
  EXPECT_NEAR(at.PredictedGain({0, 1}) / GainOf(at, c, {}), 1.0, 1e-7);
}

TEST(TrialEvaluations, PredictedGainIsThatOfAStepNearTheMinimumAndNothingThere) {
  EvaluatedTrial c;
  const SolveResult best = Solve(c.request);
  c.request.shared = best.shared;
  c.request.shared[0] *= 1.0 + 1e-6;
  c.request.initial_states = best.initial_states;
  TrialEvaluations at(c.request);
  at.PrepareForEvaluation(true, true);
  EXPECT_NEAR(at.PredictedGain({}) / (at.Cost() - best.cost), 1.0, 1e-3);
  at.MoveTo(best.shared, best.initial_states);
  at.PrepareForEvaluation(true, true);
  EXPECT_LT(at.PredictedGain({}), 1e-11 * best.cost);
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
