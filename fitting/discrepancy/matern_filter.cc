#include "fitting/discrepancy/matern_filter.h"

#include <cmath>
#include <limits>
#include <vector>

namespace hoplab {
namespace {

// The process from one row to the next.
struct Transition {
  double a00, a01, a10, a11;

  Transition(double lambda, double dt) {
    const double decay = std::exp(-lambda * dt);
    a00 = decay * (1.0 + lambda * dt);
    a01 = decay * dt;
    a10 = -decay * lambda * lambda * dt;
    a11 = decay * (1.0 - lambda * dt);
  }
};

// What the filter does at one row, whatever the data.
struct Gain {
  Transition a;
  double g0, g1, inverse_root;
};

std::vector<Gain> GainsOf(std::span<const double> times, double ratio, double time_scale,
                          std::span<const int> rows, double& half_log_det,
                          Eigen::VectorXd* log_roots) {
  const double lambda = std::sqrt(3.0) / time_scale;
  const double p0 = ratio * ratio, q0 = p0 * lambda * lambda;
  double p00 = p0, p01 = 0.0, p11 = q0;  // covariance of (delta, d delta/dt), here and now
  double last_dt = std::numeric_limits<double>::quiet_NaN();
  Transition a(lambda, 0.0);
  std::vector<Gain> gains;
  gains.reserve(times.size());
  half_log_det = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k > 0) {
      const double dt = times[k] - times[k - 1];
      if (dt != last_dt) a = Transition(lambda, last_dt = dt);
      const double d00 = p00 - p0, d01 = p01, d11 = p11 - q0;
      const double r00 = a.a00 * d00 + a.a01 * d01, r01 = a.a00 * d01 + a.a01 * d11;
      const double r10 = a.a10 * d00 + a.a11 * d01, r11 = a.a10 * d01 + a.a11 * d11;
      p00 = r00 * a.a00 + r01 * a.a01 + p0;
      p01 = r00 * a.a10 + r01 * a.a11;
      p11 = r10 * a.a10 + r11 * a.a11 + q0;
    }
    const double s = p00 + 1.0, root = std::sqrt(s), g0 = p00 / s, g1 = p01 / s;
    gains.push_back({a, g0, g1, 1.0 / root});
    p11 -= g1 * p01;
    p01 -= g0 * p01;
    p00 -= g0 * p00;
    const double log_root = std::log(root);
    half_log_det += log_root;
    if (log_roots) (*log_roots)[rows[k]] = log_root;
  }
  return gains;
}

// A few columns at a time, so that the filter's states stay in registers.
template <int kColumns>
void Filter(const std::vector<Gain>& gains, std::span<const int> rows, Eigen::Index first,
            Eigen::Ref<RowMajorMatrix> block) {
  using Row = Eigen::Array<double, 1, kColumns>;
  Row value = Row::Zero(), slope = Row::Zero();
  for (std::size_t k = 0; k < gains.size(); ++k) {
    const Gain& g = gains[k];
    if (k > 0) {
      const Row next = g.a.a00 * value + g.a.a01 * slope;
      slope = g.a.a10 * value + g.a.a11 * slope;
      value = next;
    }
    Eigen::Map<Row> row(&block(rows[k], first));
    const Row innovation = row - value;
    row = innovation * g.inverse_root;
    value += g.g0 * innovation;
    slope += g.g1 * innovation;
  }
}

}  // namespace

double WhitenMatern(std::span<const double> times, std::span<const int> rows, double ratio,
                    double time_scale,
                    Eigen::Ref<RowMajorMatrix> block,  // NOLINT: a view, whose block is written to
                    Eigen::VectorXd* log_roots) {
  double half_log_det = 0.0;
  const std::vector<Gain> gains = GainsOf(times, ratio, time_scale, rows, half_log_det, log_roots);
  Eigen::Index first = 0;
  for (; first + 8 <= block.cols(); first += 8) Filter<8>(gains, rows, first, block);
  for (; first + 4 <= block.cols(); first += 4) Filter<4>(gains, rows, first, block);
  for (; first + 2 <= block.cols(); first += 2) Filter<2>(gains, rows, first, block);
  for (; first < block.cols(); ++first) Filter<1>(gains, rows, first, block);
  return half_log_det;
}

Eigen::MatrixXd MaternProduct(std::span<const double> times, std::span<const int> rows,
                              double ratio, double time_scale, const Eigen::MatrixXd& columns) {
  const double lambda = std::sqrt(3.0) / time_scale;
  const Eigen::Index n = columns.cols();
  Eigen::RowVectorXd s0 = Eigen::RowVectorXd::Zero(n), s1 = s0;
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n, n), diagonal = lower;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (k > 0) {
      const double step = lambda * (times[k] - times[k - 1]), decay = std::exp(-step);
      s1 = decay * (s1 + step * s0);
      s0 *= decay;
    }
    const auto row = columns.row(rows[k]);
    s0 += row;
    lower += row.transpose() * (s0 + s1);
    diagonal += row.transpose() * row;
  }
  return ratio * ratio * (lower + lower.transpose() - diagonal);
}

}  // namespace hoplab
