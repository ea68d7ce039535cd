#include "fitting/solve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/read_dataset.h"
#include "fitting/trial_evaluator.h"
#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

using testing::NominalInitialStates;
using testing::SmallDataset;

using Case = testing::SmallFit;

TEST(Solve, FindsTheTruthWithinItsNoise) {
  const Case c;
  const SolveResult r = Solve(c.Request());
  EXPECT_EQ(r.status, SolveStatus::kConverged);
  EXPECT_NEAR(r.shared[0] / 22e9, 1.0, 0.01);
  EXPECT_NEAR(r.shared[1] / 3.0, 1.0, 0.05);
}

TEST(Solve, DoesNotDependOnTheNumberOfJobs) {
  const Case c;
  SolveRequest one = c.Request(), two = c.Request();
  two.jobs = 2;
  const SolveResult a = Solve(one), b = Solve(two);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.shared, b.shared);
  EXPECT_EQ(a.initial_states, b.initial_states);
}

TEST(Solve, AStartThatFallsIsNamedAndLeftBehind) {
  const Case c;
  SolveRequest request = c.Request();
  request.shared[0] = 6e9;  // so soft that it sinks to the ground
  TrialEvaluation e;
  TrialEvaluator(c.problem, c.trials[0]).Evaluate({request.shared, c.trials[0].start}, e);
  ASSERT_FALSE(e.complete);
  const SolveResult r = Solve(request);
  EXPECT_TRUE(r.complete);
  EXPECT_NEAR(r.shared[0] / 22e9, 1.0, 0.02);
  const SolveResult from_near = Solve(c.Request());
  EXPECT_NEAR(r.cost, from_near.cost, 1e-3);
}

TEST(Solve, AnEndThatFallsIsNotComplete) {
  const Case c;
  SolveRequest request = c.Request();
  request.shared[0] = 1e8;
  request.hold_shared = true;
  EXPECT_FALSE(Solve(request).complete);
}

TEST(Solve, AStepThatFallsIsRejectedWithItsReason) {
  // From a leg that only just carries, the first step overshoots into one that does not; the run
  // must end at the optimum all the same, never with residuals of zero.
  const Case c;
  SolveRequest request = c.Request();
  request.shared = Eigen::Vector2d(60e9, 0.1);
  request.hold_initial_states = true;
  const SolveResult r = Solve(request);
  ASSERT_NE(r.status, SolveStatus::kNoStart);
  int rejected = 0;
  for (const auto& [reason, count] : r.rejected) {
    EXPECT_NE(reason.find(".csv: "), std::string::npos);
    rejected += count;
  }
  EXPECT_GT(rejected, 0);
  EXPECT_GT(r.cost, 0.5 * 0.5 * static_cast<double>(c.trials[0].sample_count));
}

TEST(Solve, ABeginningFarOffIsNone) {
  const Case c;
  SolveRequest request = c.Request();
  const double cost = Solve(request).cost;
  request.start_below = 1.01 * cost;  // the beginning costs more
  const SolveResult r = Solve(request);
  EXPECT_EQ(r.status, SolveStatus::kNoStart);
  EXPECT_EQ(r.shared, request.shared);
  request.start_below = 1e12;
  EXPECT_EQ(Solve(request).status, SolveStatus::kConverged);
}

TEST(Solve, GivesUpWhatItsPaceWillNotReach) {
  const Case c;
  SolveRequest request = c.Request();
  request.function_tolerance = 0.0;
  const double cost = Solve(request).cost;
  request.give_up_above = 0.9 * cost;  // below any cost there is
  const SolveResult r = Solve(request);
  EXPECT_EQ(r.status, SolveStatus::kGaveUp);
  EXPECT_TRUE(IsUsable(r.status));
  EXPECT_GE(r.cost, cost * (1.0 - 1e-9));
  request.give_up_above = 1.1 * cost;
  EXPECT_NEAR(Solve(request).cost, cost, 1e-6 * cost);
}

TEST(Solve, HeldValuesStay) {
  const Case c;
  SolveRequest request = c.Request();
  request.held = {0};
  const SolveResult r = Solve(request);
  EXPECT_NEAR(r.shared[0] / 21e9, 1.0, 1e-15);
  EXPECT_NE(r.shared[1], 2.0);
}

TEST(Solve, HeldInitialStatesStay) {
  const Case c;
  SolveRequest request = c.Request();
  request.hold_initial_states = true;
  EXPECT_EQ(Solve(request).initial_states, request.initial_states);
}

TEST(Solve, AValueOnItsBoundDoesNotKeepTheRestFromTheirOptimum) {
  // The rig's joints are viscous: with damping of the material free, the damper d ends on zero.
  const Dataset rig = ReadDataset(std::filesystem::path(HOPLAB_SOURCE_DIR) / "datasets/rig-drops");
  const FitProblem problem =
      MakeProblem(rig, {.with_effects = {"leg_material_damping", "touchdown_loss"}});
  const std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  SolveRequest request;
  request.problem = &problem;
  request.trials = &trials;
  request.initial_states = NominalInitialStates(trials);
  request.shared = InitialShared(problem);
  request.shared[0] = 22.5e9;
  const SolveResult free = Solve(request);
  ASSERT_EQ(free.status, SolveStatus::kConverged);
  ASSERT_EQ(problem.shared[1].name, "d");
  ASSERT_LT(free.shared[1], 1e-9);
  // A step beyond the bound must not make the search crawl along it.
  EXPECT_LE(free.iterations, 15);
  request.held = {1};
  request.shared[1] = 0.0;
  EXPECT_NEAR(free.cost, Solve(request).cost, 1e-6 * free.cost);
}

TEST(Solve, StopsWhenAsked) {
  const Case c;
  std::atomic<bool> stop{true};
  SolveRequest request = c.Request();
  request.stop = &stop;
  EXPECT_EQ(Solve(request).status, SolveStatus::kInterrupted);
}

TEST(Solve, ARobustLossShrugsOffAnOutlier) {
  Case c;
  const Eigen::VectorXd clean = Solve(c.Request()).shared;
  for (int row : {20, 45, 70}) c.trials[0].data[2 * row + 1] += 0.05;  // 50 standard deviations
  SolveRequest squared = c.Request(), robust = c.Request();
  robust.loss = {LossKind::kPseudoHuber, 2.0};
  const double pulled = std::abs(Solve(squared).shared[0] - clean[0]);
  const double held = std::abs(Solve(robust).shared[0] - clean[0]);
  EXPECT_LT(held, 0.25 * pulled);
}

TEST(TrialEvaluator, RobustResidualsHaveTheRightSlope) {
  const Case c;
  const TrialEvaluator evaluator(c.problem, c.trials[0]);
  const Loss loss{LossKind::kPseudoHuber, 1.0};
  Eigen::VectorXd p = Eigen::Vector2d(24e9, 3.0);
  TrialEvaluation middle, plus, minus;
  evaluator.Evaluate({p, c.trials[0].start, true, loss}, middle);
  const double h = 1e5;  // Pa
  p[0] += h;
  evaluator.Evaluate({p, c.trials[0].start, false, loss}, plus);
  p[0] -= 2 * h;
  evaluator.Evaluate({p, c.trials[0].start, false, loss}, minus);
  const Eigen::VectorXd difference = (plus.residuals - minus.residuals) / (2 * h);
  EXPECT_LT((difference - middle.jacobian.col(0)).norm(), 1e-6 * difference.norm());
}

TEST(TrialEvaluator, SomeColumnsAreThoseOfTheWholeJacobian) {
  const Case c;
  const TrialEvaluator evaluator(c.problem, c.trials[0]);
  const Eigen::VectorXd p = Eigen::Vector2d(24e9, 3.0);
  TrialEvaluation whole, some;
  evaluator.Evaluate({p, c.trials[0].start, true}, whole);
  // From the second shared value to the second own one: priors have a column among them.
  evaluator.Evaluate(
      {.shared = p, .own = c.trials[0].start, .want_jacobian = true, .only = ColumnRange{1, 3}},
      some);
  ASSERT_TRUE(some.complete);
  EXPECT_EQ(some.residuals, whole.residuals);
  ASSERT_EQ(some.jacobian.cols(), 3);
  const auto expected = whole.jacobian.middleCols(1, 3);
  EXPECT_LT((some.jacobian - expected).norm(), 1e-12 * expected.norm());
}

TEST(TrialEvaluator, ASimulationShorterThanItsDataIsIncomplete) {
  const Case c;
  TrialEvaluation e;
  TrialEvaluator(c.problem, c.trials[0])
      .Evaluate({Eigen::Vector2d(1e8, 3.0), c.trials[0].start, false}, e);
  EXPECT_FALSE(e.complete);
  EXPECT_FALSE(IsComplete(e.trajectory.outcome));
}

TEST(TrialEvaluator, ThePriorPullsWithItsWidth) {
  const Case c;
  OwnValues start = c.trials[0].start;
  start[0] += 3 * c.trials[0].own[0].prior_sigma;
  TrialEvaluation e;
  TrialEvaluator(c.problem, c.trials[0]).Evaluate({Eigen::Vector2d(22e9, 3.0), start, true}, e);
  ASSERT_TRUE(e.complete);
  EXPECT_NEAR(e.residuals[e.data_residuals], 3.0, 1e-9);
  EXPECT_NEAR(e.jacobian(e.data_residuals, 2), 1.0 / c.trials[0].own[0].prior_sigma, 1e-9);
}

}  // namespace
}  // namespace hoplab
