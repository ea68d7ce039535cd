#include "fitting/noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

namespace hoplab {
namespace {

constexpr int kWindow = 12;
constexpr int kLeastWindow = 8;

// Residual variance about the parabola through one window.
double WindowVariance(const std::vector<double>& t, const std::vector<double>& v) {
  const int n = static_cast<int>(t.size());
  Eigen::MatrixXd A(n, 3);
  Eigen::VectorXd b(n);
  const double middle = t[n / 2], span = std::max(t.back() - t.front(), 1e-12);
  for (int i = 0; i < n; ++i) {
    const double s = (t[i] - middle) / span;
    A.row(i) << 1.0, s, s * s;
    b[i] = v[i];
  }
  const Eigen::VectorXd fitted = A.householderQr().solve(b);
  return (b - A * fitted).squaredNorm() / (n - 3);
}

}  // namespace

double EstimateNoise(std::span<const SampledColumn> columns) {
  std::vector<double> variances;
  for (const SampledColumn& column : columns) {
    std::vector<double> t, v;
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      if (std::isnan(column.values[i])) continue;
      t.push_back(column.times[i]);
      v.push_back(column.values[i]);
      if (t.size() == kWindow) {
        variances.push_back(WindowVariance(t, v));
        t.clear();
        v.clear();
      }
    }
    if (t.size() >= kLeastWindow) variances.push_back(WindowVariance(t, v));
  }
  if (variances.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  const boost::math::chi_squared chi2(kWindow - 3);
  return std::sqrt(*middle * (kWindow - 3) / boost::math::median(chi2));
}

}  // namespace hoplab
