#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace hoplab::testing {

/// Logistic regression with a ridge on the weights of standardised columns; the first entry of the
/// result is the intercept, all in the columns' own units.
inline Eigen::VectorXd FitLogistic(const Eigen::MatrixXd& columns, const Eigen::VectorXd& right,
                                   const Eigen::VectorXd& weights, double ridge = 0.03) {
  const Eigen::Index n = columns.rows(), m = columns.cols();
  const Eigen::RowVectorXd mean = columns.colwise().mean();
  Eigen::RowVectorXd sd = ((columns.rowwise() - mean).colwise().squaredNorm() / n).cwiseSqrt();
  for (double& s : sd) s = s > 1e-9 ? s : 1.0;
  Eigen::MatrixXd Z(n, m + 1);
  Z.col(0).setOnes();
  Z.rightCols(m) = (columns.rowwise() - mean).array().rowwise() / sd.array();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(m + 1);
  Eigen::VectorXd penalty = Eigen::VectorXd::Constant(m + 1, ridge);
  penalty[0] = 0.0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Eigen::VectorXd p = (1.0 + (-(Z * b)).array().exp()).inverse();
    const Eigen::VectorXd w = weights.array() * (p.array() * (1.0 - p.array())).max(1e-9);
    const Eigen::VectorXd gradient =
        Z.transpose() * Eigen::VectorXd(weights.cwiseProduct(p - right)) +
        Eigen::VectorXd(penalty.cwiseProduct(b));
    Eigen::MatrixXd H = Z.transpose() * w.asDiagonal() * Z;
    H.diagonal() += penalty;
    const Eigen::VectorXd step = H.ldlt().solve(gradient);
    b -= step;
    if (step.norm() < 1e-10) break;
  }
  Eigen::VectorXd out(m + 1);
  out.tail(m) = b.tail(m).array() / sd.transpose().array();
  out[0] = b[0] - mean.dot(out.tail(m));
  return out;
}

inline double Logistic(const Eigen::VectorXd& b, const Eigen::VectorXd& x) {
  return 1.0 / (1.0 + std::exp(-(b[0] + b.tail(x.size()).dot(x))));
}

/// Mean distance of told probability and frequency over `bins` bins of equal width, each weighted
/// by its cases.
inline double CalibrationError(const std::vector<double>& told, const std::vector<bool>& right,
                               const std::vector<double>& weights, int bins = 10) {
  std::vector<double> sum(static_cast<std::size_t>(bins));
  for (std::size_t i = 0; i < told.size(); ++i) {
    const int bin = std::clamp(static_cast<int>(told[i] * bins), 0, bins - 1);
    sum[static_cast<std::size_t>(bin)] += weights[i] * (told[i] - (right[i] ? 1.0 : 0.0));
  }
  double error = 0.0, all = 0.0;
  for (const double w : weights) all += w;
  for (const double s : sum) error += std::abs(s);
  return told.empty() ? 0.0 : error / all;
}

}  // namespace hoplab::testing
