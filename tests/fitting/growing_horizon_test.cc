// A search over the first rows, then over more and more of them.
#include "fitting/growing_horizon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

TEST(GrowingHorizon, EndsWhereASearchOverAllRowsEnds) {
  const testing::SmallFit fit;
  RoundCosts costs;
  const SolveResult grown = GrowHorizonBeside(fit.Request(), {}, costs), all = Solve(fit.Request());
  EXPECT_NEAR(grown.cost, all.cost, 1e-6 * all.cost);
  ASSERT_FALSE(costs.empty());
  // More rows, more noise to miss.
  for (std::size_t i = 1; i < costs.size(); ++i) EXPECT_GT(costs[i], costs[i - 1]);
  EXPECT_GT(grown.cost, costs.back());
}

TEST(GrowingHorizon, GoesOnBesideOneThatFitsAsWell) {
  const testing::SmallFit fit;
  RoundCosts costs, again;
  const SolveResult first = GrowHorizonBeside(fit.Request(), {}, costs);
  const SolveResult second = GrowHorizonBeside(fit.Request(), costs, again);
  EXPECT_EQ(second.cost, first.cost);
  EXPECT_EQ(again, costs);
}

// Values held far off fit every round worse than values that are free.
TEST(GrowingHorizon, GivesUpBesideOneThatFitsClearlyBetter) {
  const testing::SmallFit fit;
  RoundCosts costs, own;
  GrowHorizonBeside(fit.Request(), {}, costs);
  SolveRequest held = fit.Request();
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
