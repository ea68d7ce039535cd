// Which terms are picked in resamples of the trials.
#include "fitting/discovery/stability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/random.h"
#include "datasets/read_scenario.h"
#include "fitting/discovery/discover.h"
#include "fitting/discovery/promising.h"
#include "fitting/generate.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab {
namespace {

using namespace testing;

// Trials of noise with columns of their own: `planted` of them times `size` in the residuals.
Linearisation Synthetic(int trials, int rows, int columns, int planted, double size) {
  Linearisation at;
  const int all = trials * rows;
  RandomStream random(3, 1);
  at.columns.resize(all, columns);
  for (Eigen::Index i = 0; i < at.columns.size(); ++i) at.columns.data()[i] = random.Normal();
  at.columns.col(columns - 1) = -2.0 * at.columns.col(0);  // the first again
  at.r.resize(all);
  for (Eigen::Index i = 0; i < all; ++i) at.r[i] = random.Normal();
  at.r -= size * at.columns.col(planted);
  at.fitted_basis.resize(all, 0);
  at.along_fitted.resize(0, columns);
  at.length = at.columns.colwise().norm();
  for (int t = 0; t < trials; ++t)
    for (int i = 0; i < rows; ++i) {
      RowLabel label;
      label.trial = t;
      at.labels.push_back(label);
    }
  return at;
}

TEST(Stability, EqualColumnsAreOneGroup) {
  const auto groups = EqualColumns(Synthetic(4, 30, 6, 2, 0.0));
  ASSERT_EQ(groups.size(), 5u);
  EXPECT_EQ(groups[0], (std::vector<int>{0, 5}));
}

TEST(Stability, AStrongTermIsPickedFirstAndInEveryResample) {
  const Linearisation at = Synthetic(6, 40, 6, 2, 0.5);
  const std::vector<int> columns = {0, 1, 2, 3, 4};
  const auto picks = PickForward(at, columns, 3, 5.0);
  ASSERT_EQ(picks.size(), 1u);
  EXPECT_EQ(picks[0].column, 2);
  // Half of the square of what lies along it.
  const double along = at.columns.col(2).dot(at.r);
  EXPECT_NEAR(picks[0].gain, 0.5 * along * along / at.columns.col(2).squaredNorm(), 1e-9);
  EXPECT_NEAR(ShareOfResamples(at, columns, {{2}, {3}}, 1, 5.0, 1)[0], 1.0, 1e-9);
  EXPECT_EQ(ShareOfResamples(at, columns, {{2}, {3}}, 1, 5.0, 1)[1], 0.0);
}

TEST(Stability, NoiseAloneIsSeldomPicked) {
  const Linearisation at = Synthetic(6, 40, 6, 2, 0.0);
  EXPECT_TRUE(PickForward(at, {0, 1, 2, 3, 4}, 3, 6.0).empty());
  EXPECT_TRUE(ShareOfResamples(Synthetic(1, 40, 6, 2, 0.5), {0, 1, 2}, {{2}}, 1, 5.0, 1).empty())
      << "one trial cannot be drawn anew";
}

// What the fitted values explain counts for no term.
TEST(Stability, TheFittedPartIsTakenOutOfEachResample) {
  Linearisation at = Synthetic(6, 40, 6, 2, 0.5);
  const Eigen::VectorXd fitted = at.columns.col(2).normalized();
  at.along_fitted = fitted.transpose() * at.columns;
  at.columns -= fitted * at.along_fitted;
  at.r -= fitted * fitted.dot(at.r);
  at.fitted_basis = fitted;
  for (const double share : ShareOfResamples(at, {0, 1, 2, 3, 4}, {{2}}, 1, 3.0, 1))
    EXPECT_LT(share, 0.05);
}

}  // namespace
}  // namespace hoplab
