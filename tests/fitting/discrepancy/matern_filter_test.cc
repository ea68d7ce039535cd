#include "fitting/discrepancy/matern_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace hoplab {
namespace {

// The covariance by its definition.
Eigen::MatrixXd Covariance(const std::vector<double>& t, double ratio, double scale) {
  const auto n = static_cast<Eigen::Index>(t.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double x = std::sqrt(3.0) * std::abs(t[i] - t[j]) / scale;
      C(i, j) += ratio * ratio * (1.0 + x) * std::exp(-x);
    }
  }
  return C;
}

struct Series {
  std::vector<double> times;
  std::vector<int> rows;
  RowMajorMatrix block;

  // Rows at uneven times, in some order among others that are not theirs.
  Series(int count, std::uint64_t seed) : block(2 * count, 4) {
    RandomStream random(seed, 0);
    double t = 0.0;
    for (int k = 0; k < count; ++k) {
      t += random.Uniform(1e-4, 0.02) + (k % 17 == 5 ? 0.3 : 0.0);  // with gaps
      times.push_back(t);
      rows.push_back(2 * k + (k % 2));
    }
    for (Eigen::Index i = 0; i < block.size(); ++i) block.data()[i] = random.Normal();
  }
};

TEST(WhitenMatern, IsTheInverseOfTheCholeskyFactorOfTheCovariance) {
  for (const double scale : {0.003, 0.05, 1.0}) {
    for (const double ratio : {0.1, 3.0, 50.0}) {
      Series s(80, 5);
      const RowMajorMatrix before = s.block;
      const double half_log_det = WhitenMatern(s.times, s.rows, ratio, scale, s.block);
      const Eigen::LLT<Eigen::MatrixXd> llt(Covariance(s.times, ratio, scale));
      Eigen::MatrixXd expected(80, 4);
      for (int k = 0; k < 80; ++k) expected.row(k) = before.row(s.rows[k]);
      expected = llt.matrixL().solve(expected);
      double error = 0.0;
      for (int k = 0; k < 80; ++k)
        error = std::max(error, (s.block.row(s.rows[k]) - expected.row(k)).cwiseAbs().maxCoeff());
      EXPECT_LT(error, 1e-10) << scale << ' ' << ratio;
      const Eigen::MatrixXd L = llt.matrixL();
      EXPECT_NEAR(half_log_det, L.diagonal().array().log().sum(), 1e-10) << scale << ' ' << ratio;
    }
  }
}

TEST(WhitenMatern, LeavesOtherRowsAlone) {
  Series s(20, 6);
  const RowMajorMatrix before = s.block;
  WhitenMatern(s.times, s.rows, 2.0, 0.1, s.block);
  for (int row = 0; row < 40; ++row) {
    if (std::find(s.rows.begin(), s.rows.end(), row) != s.rows.end()) continue;
    EXPECT_EQ(s.block.row(row), before.row(row)) << row;
  }
}

TEST(WhitenMatern, WithoutAmplitudeChangesNothing) {
  Series s(30, 7);
  const RowMajorMatrix before = s.block;
  EXPECT_EQ(WhitenMatern(s.times, s.rows, 0.0, 0.1, s.block), 0.0);
  EXPECT_EQ(s.block, before);
}

TEST(MaternProduct, IsTheCovarianceBetweenColumns) {
  for (const double scale : {0.003, 0.05, 1.0}) {
    for (const double ratio : {0.1, 3.0, 50.0}) {
      const Series s(80, 7);
      Eigen::MatrixXd own(80, 4);
      for (int k = 0; k < 80; ++k) own.row(k) = s.block.row(s.rows[k]);
      const Eigen::MatrixXd K =
          Covariance(s.times, ratio, scale) - Eigen::MatrixXd::Identity(80, 80);
      const Eigen::MatrixXd expected = own.transpose() * K * own;
      const Eigen::MatrixXd found = MaternProduct(s.times, s.rows, ratio, scale, s.block);
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-11 * expected.cwiseAbs().maxCoeff())
          << scale << ' ' << ratio;
    }
  }
}

}  // namespace
}  // namespace hoplab
