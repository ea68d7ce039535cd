// One trial's deviation of a shared value: what acts, its derivative, its bounds.

#include "fitting/deviation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/diagnosis/candidate.h"
#include "fitting/solve.h"
#include "fitting/trial_evaluator.h"
#include "tests/support/diagnosed_hops.h"
#include "tests/support/richardson.h"

namespace hoplab {
namespace {

constexpr double kSpread = 0.02;

// Hops with drag, its size and E free to deviate in each trial.
struct Deviating {
  FitProblem problem;
  Eigen::VectorXd shared;
  int drag = 0, modulus = 0;

  Deviating() {
    const Dataset dataset =
        testing::DatasetOf({.effects = {testing::EffectOfSize("air_drag", 0.05)}});
    problem = Extend(MakeProblem(dataset, {}), std::array{testing::CandidateOf("air_drag")});
    problem.integrator.relative_tolerance = 1e-12;
    problem.integrator.absolute_tolerance = 1e-13;
    drag = problem.shared_count() - 1;
    shared = InitialShared(problem);
    shared[drag] = 0.05;
    while (problem.shared[static_cast<std::size_t>(modulus)].name != "E") ++modulus;
    for (TrialProblem& t : problem.trials) {
      EXPECT_TRUE(AddDeviation(problem, drag, kSpread, t));
      EXPECT_TRUE(AddDeviation(problem, modulus, 1e9, t));
    }
  }
  TrialProblem& trial() { return problem.trials.front(); }
  TrialEvaluation At(const Eigen::VectorXd& values, const OwnValues& own) {
    TrialEvaluation e;
    TrialEvaluator(problem, trial()).Evaluate({values, own, true}, e);
    EXPECT_TRUE(e.complete);
    return e;
  }
  int ColumnOf(int own) const { return problem.shared_count() + own; }
};

TEST(Deviation, IsAddedToTheSharedValue) {
  Deviating c;
  OwnValues own = c.trial().start;
  const int k = *DeviationOf(c.drag, c.trial());
  own[k] = 0.03;
  const TrialEvaluation deviating = c.At(c.shared, own);
  Eigen::VectorXd moved = c.shared;
  moved[c.drag] += 0.03;
  const TrialEvaluation shared = c.At(moved, c.trial().start);
  const int data = shared.data_residuals;
  EXPECT_LT((deviating.residuals.head(data) - shared.residuals.head(data)).norm(), 1e-9);
  // Its prior: mean 0, sigma the spread.
  EXPECT_NEAR(deviating.residuals.squaredNorm() - shared.residuals.squaredNorm(),
              std::pow(0.03 / kSpread, 2), 1e-6);
}

TEST(Deviation, ItsColumnIsTheDerivativeOfTheResiduals) {
  Deviating c;
  for (const int place : {c.drag, c.modulus}) {
    const int k = *DeviationOf(place, c.trial());
    OwnValues own = c.trial().start;
    own[*DeviationOf(c.drag, c.trial())] = 0.01;
    const TrialEvaluation e = c.At(c.shared, own);
    const double h = 0.05 * c.trial().own[static_cast<std::size_t>(k)].scale;
    const testing::DifferenceColumn difference = testing::RichardsonDerivative(
        [&](double value) {
          OwnValues moved = own;
          moved[k] = value;
          const Eigen::VectorXd r = c.At(c.shared, moved).residuals;
          return std::vector<double>(r.begin(), r.end());
        },
        own[k], h);
    const Eigen::Map<const Eigen::VectorXd> expected(
        difference.value.data(), static_cast<Eigen::Index>(difference.value.size()));
    EXPECT_LT((e.jacobian.col(c.ColumnOf(k)) - expected).norm(), 1e-6 * expected.norm())
        << c.problem.shared[static_cast<std::size_t>(place)].name;
    // The shared value moves the data as its deviation does.
    const int data = e.data_residuals;
    EXPECT_LT((e.jacobian.col(place).head(data) - expected.head(data)).norm(),
              1e-6 * expected.norm());
  }
}

TEST(Deviation, IsCutToTheBoundsOfTheSharedValue) {
  Deviating c;
  const int k = *DeviationOf(c.drag, c.trial());
  OwnValues beyond = c.trial().start, bound = beyond;
  beyond[k] = -0.08;
  bound[k] = -0.05;
  EXPECT_EQ(ActingShared(c.problem, c.trial(), c.shared, beyond)[c.drag], 0.0);
  const TrialEvaluation cut = c.At(c.shared, beyond), on = c.At(c.shared, bound);
  const int data = cut.data_residuals;
  EXPECT_EQ((cut.residuals.head(data) - on.residuals.head(data)).norm(), 0.0);
  // Beyond nothing answers but the prior; on the bound the data do.
  for (const int column : {c.drag, c.ColumnOf(k)}) {
    EXPECT_EQ(cut.jacobian.col(column).head(data).norm(), 0.0);
    EXPECT_GT(on.jacobian.col(column).head(data).norm(), 0.0);
  }
  EXPECT_GT(cut.jacobian.col(c.ColumnOf(k)).norm(), 0.0);
}

// Without drag in the data a trial's size is pulled below zero: it ends on the bound.
TEST(Deviation, OfASearchStaysWithinTheBounds) {
  const Dataset dataset = testing::DatasetOf({.sigma_m = 2e-4});
  FitProblem problem =
      Extend(MakeProblem(dataset, {}), std::array{testing::CandidateOf("air_drag")});
  const int drag = problem.shared_count() - 1;
  std::vector<TrialProblem> trials = {problem.trials.front()};
  ASSERT_TRUE(AddDeviation(problem, drag, 0.05, trials.front()));
  SolveRequest request;
  request.problem = &problem;
  request.trials = &trials;
  request.shared = InitialShared(problem);
  request.shared[drag] = 0.004;
  request.held = {drag};
  request.initial_states = {trials.front().start};
  request.initial_states[0][*DeviationOf(drag, trials.front())] = 0.05;
  const SolveResult result = Solve(request);
  ASSERT_TRUE(IsUsable(result.status)) << result.message;
  const double size =
      result.shared[drag] + result.initial_states[0][*DeviationOf(drag, trials.front())];
  EXPECT_GE(size, -1e-12);
  EXPECT_LT(size, 0.004);
}

TEST(Deviation, GoesWithAPieceOfItsTrialAndKeepsItsPrior) {
  Deviating c;
  const int rows = static_cast<int>(c.trial().row_times.size());
  const TrialProblem piece = CutTrial(c.problem, c.trial(), rows / 2, rows);
  const std::optional<int> k = DeviationOf(c.drag, piece);
  ASSERT_TRUE(k);
  EXPECT_EQ(piece.own[static_cast<std::size_t>(*k)].prior_sigma, kSpread);
  EXPECT_EQ(piece.start[*k], 0.0);
}

TEST(Deviation, IsOnlyOfAValueThatActsInTheTrial) {
  Deviating c;
  c.problem.shared[static_cast<std::size_t>(c.drag)].only_recordings = {
      c.problem.trials[1].recording};
  TrialProblem other = testing::NullFit(testing::World{}).train.front();
  other.recording = "elsewhere.csv";
  EXPECT_FALSE(AddDeviation(c.problem, c.drag, kSpread, other));
  EXPECT_FALSE(DeviationOf(c.drag, other));
}

}  // namespace
}  // namespace hoplab
