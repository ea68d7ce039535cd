#include "experiments/study/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/nan.h"

namespace hoplab::testing {
namespace {

using Numbers = std::vector<double>;

TEST(Agreement, LeavesOutPairsWithAHole) {
  const Agreement a = AgreementOf(Numbers{1.0, kNaN, 3.0, 5.0}, Numbers{2.0, 7.0, kNaN, 2.0});
  EXPECT_EQ(a.pairs, 2);
  EXPECT_DOUBLE_EQ(a.rms, std::sqrt((1.0 + 9.0) / 2.0));
  EXPECT_DOUBLE_EQ(a.max_abs, 3.0);
  EXPECT_DOUBLE_EQ(a.mean, -1.0);
}

TEST(Agreement, OfNothingIsMissingNotZero) {
  const Agreement a = AgreementOf(Numbers{kNaN}, Numbers{1.0});
  EXPECT_EQ(a.pairs, 0);
  EXPECT_TRUE(std::isnan(a.rms) && std::isnan(a.max_abs) && std::isnan(a.mean));
}

TEST(RankCorrelation, OfATextbookExample) {
  // Quotients and hours of television of ten persons; rho = -29/165.
  const Numbers quotient = {106, 100, 86, 101, 99, 103, 97, 113, 112, 110};
  const Numbers hours = {7, 27, 2, 50, 28, 29, 20, 12, 6, 17};
  EXPECT_NEAR(RankCorrelation(quotient, hours), -29.0 / 165.0, 1e-14);
}

TEST(RankCorrelation, TiesHaveTheirMeanRank) {
  // Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: covariance 4.5, variances 4.5 and 5.
  EXPECT_NEAR(RankCorrelation(Numbers{1, 2, 2, 3}, Numbers{1, 2, 3, 4}), 4.5 / std::sqrt(22.5),
              1e-14);
}

TEST(RankCorrelation, OfAConstantOrOfTwoPairsIsMissing) {
  EXPECT_TRUE(std::isnan(RankCorrelation(Numbers{1, 2, 3}, Numbers{4, 4, 4})));
  EXPECT_TRUE(std::isnan(RankCorrelation(Numbers{1, 2, 3}, Numbers{4, 5, kNaN})));
}

// S of Kendall's test.
double ScoreOf(const Numbers& a, const Numbers& b) {
  double s = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double p = (a[i] - a[j]) * (b[i] - b[j]);
      s += p > 0.0 ? 1.0 : p < 0.0 ? -1.0 : 0.0;
    }
  }
  return s;
}

TEST(Trend, PValueHasTheVarianceOfAllPermutations) {
  const Numbers a = {1, 2, 2, 3, 4, 4}, b = {1, 3, 2, 2, 5, 5};
  std::vector<int> order = {0, 1, 2, 3, 4, 5};
  double sum = 0.0, square = 0.0, count = 0.0;
  do {
    Numbers shuffled;
    for (const int i : order) shuffled.push_back(b[i]);
    const double s = ScoreOf(a, shuffled);
    sum += s;
    square += s * s;
    count += 1.0;
  } while (std::next_permutation(order.begin(), order.end()));
  ASSERT_NEAR(sum, 0.0, 1e-9);
  const double z = (ScoreOf(a, b) - 1.0) / std::sqrt(square / count);
  const Trend trend = TrendOf(a, b);
  EXPECT_NEAR(trend.p_value, std::erfc(z / std::sqrt(2.0)), 1e-12);
  // 15 pairs, two of them tied in a and two in b.
  EXPECT_NEAR(trend.tau, ScoreOf(a, b) / 13.0, 1e-14);
}

TEST(Trend, OfTenRisingValuesIsOne) {
  const Numbers a = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  Numbers b = a;
  EXPECT_NEAR(TrendOf(a, b).tau, 1.0, 1e-14);
  EXPECT_NEAR(TrendOf(a, b).p_value, std::erfc(44.0 / std::sqrt(125.0 * 2.0)), 1e-14);
  std::reverse(b.begin(), b.end());
  EXPECT_NEAR(TrendOf(a, b).tau, -1.0, 1e-14);
}

TEST(Trend, OfAConstantIsNoneAndOfTooLittleIsMissing) {
  EXPECT_EQ(TrendOf(Numbers{1, 2, 3}, Numbers{5, 5, 5}).tau, 0.0);
  EXPECT_EQ(TrendOf(Numbers{1, 2, 3}, Numbers{5, 5, 5}).p_value, 1.0);
  EXPECT_TRUE(std::isnan(TrendOf(Numbers{1, 2}, Numbers{1, 2}).tau));
  EXPECT_TRUE(std::isnan(TrendOf(Numbers{1, 1, 1}, Numbers{1, 2, 3}).p_value));
}

}  // namespace
}  // namespace hoplab::testing
