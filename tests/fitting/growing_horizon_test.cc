// A search over the first rows, then over more and more of them.
#include "fitting/growing_horizon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

using testing::NominalStarts;
using testing::SmallDataset;

class GrowingHorizon : public ::testing::Test {
 protected:
  SolveRequest Request() const {
    SolveRequest r;
    r.problem = &problem_;
    r.trials = &trials_;
    r.shared = Eigen::Vector2d(21e9, 2.0);
    r.starts = NominalStarts(trials_);
    return r;
  }
  FitProblem problem_ = MakeProblem(SmallDataset(), {});
  std::vector<TrialProblem> trials_ = TrialsOf(problem_, TrialRole::kTrain);
};

TEST_F(GrowingHorizon, EndsWhereASearchOverAllRowsEnds) {
  RoundCosts costs;
  const SolveResult grown = GrowHorizonBeside(Request(), {}, costs), all = Solve(Request());
  EXPECT_NEAR(grown.cost, all.cost, 1e-6 * all.cost);
  ASSERT_FALSE(costs.empty());
  // More rows, more noise to miss.
  for (std::size_t i = 1; i < costs.size(); ++i) EXPECT_GT(costs[i], costs[i - 1]);
  EXPECT_GT(grown.cost, costs.back());
}

TEST_F(GrowingHorizon, GoesOnBesideOneThatFitsAsWell) {
  RoundCosts costs, again;
  const SolveResult first = GrowHorizonBeside(Request(), {}, costs);
  const SolveResult second = GrowHorizonBeside(Request(), costs, again);
  EXPECT_EQ(second.cost, first.cost);
  EXPECT_EQ(again, costs);
}

// Values held far off fit every round worse than values that are free.
TEST_F(GrowingHorizon, GivesUpBesideOneThatFitsClearlyBetter) {
  RoundCosts costs, own;
  GrowHorizonBeside(Request(), {}, costs);
  SolveRequest held = Request();
  held.held = {0, 1};
  const SolveResult worse = GrowHorizonBeside(held, costs, own);
  EXPECT_EQ(worse.status, SolveStatus::kGaveUp);
  EXPECT_FALSE(worse.complete);
  EXPECT_TRUE(std::isinf(worse.cost));
  EXPECT_LT(own.size(), costs.size());
  EXPECT_TRUE(std::isfinite(GrowHorizon(held).cost));
}

}  // namespace
}  // namespace hoplab
