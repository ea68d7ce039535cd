#include "fitting/noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <utility>

namespace hoplab {
namespace {

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

// Standard deviation behind windows' variances of which the largest are no noise: at a low rate two
// in five windows meet a stance. So it starts from the lower quartile; then windows beyond the
// 99.9 % point of their chi-square are set aside and the median of the rest counts, until that
// settles. (The plain median came out a quarter too large, enough to overrule a stated sigma.)
double ScaleOf(std::vector<double> variances) {
  constexpr int kRounds = 20;
  if (variances.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  std::sort(variances.begin(), variances.end());
  const boost::math::chi_squared chi2(kNoiseWindow - 3);
  const auto quantile = [&](std::size_t count, double share) {
    const auto place = static_cast<std::size_t>(share * static_cast<double>(count));
    return variances[place] * (kNoiseWindow - 3) / boost::math::quantile(chi2, share);
  };
  double square = quantile(variances.size(), 0.25);
  const double reach = boost::math::quantile(chi2, 0.999) / (kNoiseWindow - 3);
  for (int round = 0; round < kRounds; ++round) {
    const auto kept = static_cast<std::size_t>(
        std::upper_bound(variances.begin(), variances.end(), reach * square) - variances.begin());
    const double next = quantile(std::max<std::size_t>(kept, 1), 0.5);
    if (next == square) break;
    square = next;
  }
  return std::sqrt(square);
}

}  // namespace

namespace {

// Of every `apart`-th sample; NaN when there are too few.
double NoiseOf(std::span<const SampledColumn> columns, std::size_t apart) {
  std::vector<double> variances;
  for (const SampledColumn& column : columns) {
    std::vector<double> t, v;
    for (std::size_t i = 0; i < column.values.size(); i += apart) {
      if (std::isnan(column.values[i])) continue;
      t.push_back(column.times[i]);
      v.push_back(column.values[i]);
      if (t.size() == kNoiseWindow) {
        variances.push_back(WindowVariance(t, v));
        t.clear();
        v.clear();
      }
    }
    if (t.size() >= kLeastWindow) variances.push_back(WindowVariance(t, v));
  }
  return ScaleOf(std::move(variances));
}

}  // namespace

double EstimateNoise(std::span<const SampledColumn> columns) {
  std::size_t apart = IsSmoothed(columns) ? ApartIn(columns) : 1;
  double noise = NoiseOf(columns, apart);
  for (; std::isnan(noise) && apart > 1; noise = NoiseOf(columns, apart)) apart /= 2;
  return noise;
}

}  // namespace hoplab
