// A search over the first rows, then over more and more of them.
#include "fitting/growing_horizon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fitting/trial_errors.h"
#include "tests/support/fit_cases.h"
#include "tests/support/robot_drops.h"

namespace hoplab {
namespace {

TEST(GrowingHorizon, EndsWhereASearchOverAllRowsEnds) {
  const testing::SmallFit fit;
  Rounds rounds;
  const SolveResult grown = GrowHorizonBeside(fit.Request(), {}, rounds),
                    all = Solve(fit.Request());
  EXPECT_NEAR(grown.cost, all.cost, 1e-6 * all.cost);
  ASSERT_FALSE(rounds.empty());
  // More rows, more noise to miss.
  for (std::size_t i = 1; i < rounds.size(); ++i) EXPECT_GT(rounds[i].cost, rounds[i - 1].cost);
  EXPECT_GT(grown.cost, rounds.back().cost);
}

TEST(GrowingHorizon, GoesOnFromWhatIsKnown) {
  const testing::SmallFit fit;
  SolveRequest request = fit.Request();
  const SolveResult all = Solve(request);
  std::vector<int> rounds;
  request.progress = [&](int iteration, double) {
    if (iteration == 0) rounds.push_back(0);
  };
  const double longest = request.trials->front().row_times.back();
  const SolveResult from_start = GrowHorizon(request);
  const std::size_t every_round = rounds.size();
  rounds.clear();
  const SolveResult from_late = GrowHorizon(request, 0.8 * longest);
  EXPECT_NEAR(from_late.cost, all.cost, 1e-6 * all.cost);
  EXPECT_NEAR(from_start.cost, all.cost, 1e-6 * all.cost);
  EXPECT_LT(rounds.size(), every_round);
}

// One that ends a round at the other's values is that other from there on.
TEST(GrowingHorizon, GivesUpBesideOneItHasJoined) {
  const testing::SmallFit fit;
  Rounds rounds, again;
  GrowHorizonBeside(fit.Request(), {}, rounds);
  EXPECT_EQ(GrowHorizonBeside(fit.Request(), rounds, again).status, SolveStatus::kGaveUp);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again.front(), rounds.front());
}

// At the same costs, but at other values, it goes on.
TEST(GrowingHorizon, GoesOnBesideOneThatFitsAsWell) {
  const testing::SmallFit fit;
  Rounds rounds, again;
  const SolveResult first = GrowHorizonBeside(fit.Request(), {}, rounds);
  Rounds elsewhere = rounds;
  for (Round& round : elsewhere) round.shared *= 1.01;
  const SolveResult second = GrowHorizonBeside(fit.Request(), elsewhere, again);
  EXPECT_EQ(second.cost, first.cost);
  EXPECT_EQ(again, rounds);
}

// Values held far off fit every round worse than values that are free.
TEST(GrowingHorizon, GivesUpBesideOneThatFitsClearlyBetter) {
  const testing::SmallFit fit;
  Rounds rounds, own;
  GrowHorizonBeside(fit.Request(), {}, rounds);
  SolveRequest held = fit.Request();
  held.held = {0, 1};
  const SolveResult worse = GrowHorizonBeside(held, rounds, own);
  EXPECT_EQ(worse.status, SolveStatus::kGaveUp);
  EXPECT_FALSE(worse.complete);
  EXPECT_TRUE(std::isinf(worse.cost));
  EXPECT_LT(own.size(), rounds.size());
  EXPECT_TRUE(std::isfinite(GrowHorizon(held).cost));
}

// A search that ends its first round where another did is that other.
TEST(GrowingHorizon, GivesUpElsewhereWhereItIsTheOthersMinimum) {
  const testing::SmallFit fit;
  Rounds rounds;
  GrowHorizonBeside(fit.Request(), {}, rounds);
  SolveRequest request = fit.Request();
  EXPECT_EQ(GrowHorizonElsewhere(request, rounds).status, SolveStatus::kGaveUp);
  // One that fits better in every round is another, and so is one that comes to something.
  Rounds worse = rounds, none = rounds;
  for (Round& round : worse) round.cost += 1.0 + 0.1 * round.cost;
  for (Round& round : none) round.cost = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(IsUsable(GrowHorizonElsewhere(request, worse).status));
  EXPECT_TRUE(IsUsable(GrowHorizonElsewhere(request, none).status));
}

// The front leg meets the ground at the end of the first rows. What two rows say of its stiffness
// sent it to where no later round could begin, and the fit was refused.
TEST(GrowingHorizon, ALegStillInTheAirKeepsItsStiffness) {
  Scenario drop = testing::RobotDrops(
      {{"controller", "{type: held, angles_rad: [0.2392, 0.6483]}"},
       {"initial",
        "{x_m: 0, y_m: 0.2288, vx_m_per_s: 0.309, vy_m_per_s: -0.043, pitch_rad: 0.0024, "
        "pitch_rate_rad_per_s: -0.164}"}});
  drop.dataset->trials.resize(1);
  std::erase_if(drop.dataset->channels,
                [](const ChannelSpec& c) { return NameOf(c.id).starts_with("hip_torque"); });
  GenerateOptions options;
  options.seed = 1;
  FitProblem problem = MakeProblem(GenerateDataset(drop, options).dataset, {});
  ASSERT_EQ(problem.shared_names(), (std::vector<std::string>{"E_1", "E_2", "leg_damping"}));
  const double told[] = {24e9, 24e9, 3e-4};
  for (std::size_t k = 0; k < 3; ++k) problem.shared[k].initial = told[k];
  const FitResult fit = Fit(problem, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_TRUE(fit.stop.IsMinimum());
  EXPECT_NEAR(fit.shared[0], 22e9, 0.02 * 22e9);
  EXPECT_NEAR(fit.shared[1], 22e9, 0.02 * 22e9);
}

// The start of a held-out drop that a model alike had leads to where rounds from the stated one do.
TEST(GrowingHorizon, AHeldOutStartIsFoundFromThatOfAModelAlike) {
  const FitProblem problem = MakeProblem(GenerateDataset(testing::RobotDrops(), {}).dataset, {});
  FitResult fit = Fit(problem, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  const std::vector<TrialErrors> like = AssessTrials(problem, fit, {}, /*test_only=*/true);
  fit.shared *= 1.01;
  const TrialErrors from_stated = AssessTrials(problem, fit, {}, /*test_only=*/true).back();
  const TrialErrors from_like = AssessTrials(problem, fit, {}, /*test_only=*/true, &like).back();
  EXPECT_NE(from_like.start, like.back().start);
  EXPECT_NEAR(from_like.chi2, from_stated.chi2, 1e-6 * from_stated.chi2);
  EXPECT_GT(from_like.chi2, 1.01 * like.back().chi2);
  // A start from which nothing is followed is no beginning.
  std::vector<TrialErrors> astray = like;
  astray.back().start[1] = 5.0;
  const TrialErrors from_astray =
      AssessTrials(problem, fit, {}, /*test_only=*/true, &astray).back();
  EXPECT_NEAR(from_astray.chi2, from_stated.chi2, 1e-6 * from_stated.chi2);
}

}  // namespace
}  // namespace hoplab
