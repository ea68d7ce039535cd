// Of a robot's trials, as much as a model can follow.
#include "fitting/followed_part.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fitting/fit_dataset.h"
#include "fitting/trial_evaluator.h"
#include "tests/support/robot_pronks.h"

namespace hoplab {
namespace {

// How many legs of a trial have landed and left again by a time.
int LegsThatStood(const FitProblem& problem, const TrialProblem& trial, double until) {
  TrialEvaluation e;
  TrialEvaluator(problem, trial).Evaluate({InitialShared(problem), trial.start, false}, e);
  int stood = 0;
  for (const int leg : {0, 1}) {
    bool landed = false, left = false;
    for (const Event& event : e.trajectory.events) {
      if (event.leg != leg || event.time > until) continue;
      landed = landed || event.kind == EventKind::kTouchdown;
      left = left || (landed && event.kind == EventKind::kLiftoff);
    }
    stood += left;
  }
  return stood;
}

TEST(FollowedPart, FirstStancesAreOverWhenEveryLegHasStoodOnce) {
  const FitProblem problem = MakeProblem(testing::RobotPronks(0.0, 0.6), {});
  const std::optional<double> until = FirstStancesOver(problem);
  ASSERT_TRUE(until);
  int stood_before = 0;
  for (const TrialProblem& trial : problem.trials) {
    EXPECT_EQ(LegsThatStood(problem, trial, *until), 2) << trial.file;
    stood_before += LegsThatStood(problem, trial, *until / 1.1 - 1e-9);
  }
  // A tenth more at most.
  EXPECT_LT(stood_before, 2 * static_cast<int>(problem.trials.size()));
}

TEST(FollowedPart, FirstStancesAreNotSeenInTheAir) {
  EXPECT_FALSE(FirstStancesOver(MakeProblem(testing::RobotPronks(0.0, 0.02), {})));
}

TEST(FollowedPart, APartHoldsTheFirstRowsOfEveryTrial) {
  const FitProblem problem = MakeProblem(testing::RobotPronks(0.0, 0.6), {});
  const FitProblem part = FirstPart(problem, 0.25);
  ASSERT_EQ(part.trials.size(), problem.trials.size());
  for (std::size_t i = 0; i < part.trials.size(); ++i) {
    const TrialProblem &cut = part.trials[i], &whole = problem.trials[i];
    EXPECT_LE(cut.row_times.back(), 0.25);
    EXPECT_GT(whole.row_times[cut.row_times.size()], 0.25);
    EXPECT_TRUE(std::equal(cut.data.begin(), cut.data.end(), whole.data.begin()));
  }
  EXPECT_DOUBLE_EQ(LongestTrial(problem.trials), 0.6);
}

// Longer and longer, or, where the first stances fail, shorter, and then none as long as what
// failed.
TEST(FollowedPart, PartsGrowFromTheFirstStancesAndShrinkWhereTheseFail) {
  const FitProblem problem = MakeProblem(testing::RobotPronks(0.0, 0.6), {});
  const double stances = *FirstStancesOver(problem);
  Parts grows(problem);
  ASSERT_TRUE(grows.IsLeft());
  EXPECT_EQ(grows.until(), stances);
  grows.Follows();
  EXPECT_DOUBLE_EQ(grows.until(), kLonger * stances);
  EXPECT_FALSE(grows.IsShorterThanStances());
  grows.Fails();
  EXPECT_FALSE(grows.IsLeft());

  Parts shrinks(problem);
  shrinks.Fails();
  ASSERT_TRUE(shrinks.IsLeft());
  EXPECT_DOUBLE_EQ(shrinks.until(), stances / kLonger);
  EXPECT_TRUE(shrinks.IsShorterThanStances());
  EXPECT_GT(shrinks.until(), LeastPart(problem));
  Parts follows = shrinks;
  follows.Follows();
  EXPECT_FALSE(follows.IsLeft());
  for (int k = 0; k < kShorterParts; ++k) shrinks.Fails();
  EXPECT_FALSE(shrinks.IsLeft());
}

// A leg of every trial has landed in the least part, and none has in half of it.
TEST(FollowedPart, TheLeastPartHoldsALanding) {
  const FitProblem problem = MakeProblem(testing::RobotPronks(0.0, 0.6), {});
  const double least = LeastPart(problem);
  for (const TrialProblem& trial : problem.trials) {
    TrialEvaluation e;
    TrialEvaluator(problem, trial).Evaluate({InitialShared(problem), trial.start, false}, e);
    const auto landed =
        std::find_if(e.trajectory.events.begin(), e.trajectory.events.end(),
                     [](const Event& event) { return event.kind == EventKind::kTouchdown; });
    ASSERT_NE(landed, e.trajectory.events.end());
    EXPECT_LT(landed->time, least);
    EXPECT_GT(landed->time, 0.5 * least);
  }
}

// Motors that lag by so much that no values of the model without it follow its robot through the
// first stances.
TEST(FollowedPart, IsShorterThanTheFirstStancesWhereTheseCannotBeFollowed) {
  FitOptions options;
  options.jobs = 2;
  const FitProblem problem =
      MakeProblem(testing::RobotPronks(0.0, 0.6, "{motor_lag: {t_lag: 0.03}}"), {});
  const std::optional<double> stances = FirstStancesOver(problem);
  ASSERT_TRUE(stances);
  const FitResult over = Fit(FirstPart(problem, *stances), options);
  EXPECT_FALSE(over.ok && over.stop.IsMinimum()) << over.message;
  const std::optional<FollowedPart> part = FitFollowedPart(problem, options);
  ASSERT_TRUE(part);
  EXPECT_LT(part->until, *stances);
  EXPECT_TRUE(part->result.stop.IsMinimum());
}

}  // namespace
}  // namespace hoplab
