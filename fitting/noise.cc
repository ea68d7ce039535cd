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
// At a low rate a window as long as usual is longer than a flight. Where it lasts longer than this
// [s], windows of this many samples are looked at, too.
constexpr double kLongWindow = 0.25;
constexpr int kShortWindow = 5;
// Their result counts where it is less than this share of the usual one, which stances have raised.
constexpr double kClearlyLess = 0.5;

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
double ScaleOf(std::vector<double> variances, int window) {
  constexpr int kRounds = 20;
  if (variances.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  std::sort(variances.begin(), variances.end());
  const boost::math::chi_squared chi2(window - 3);
  const auto quantile = [&](std::size_t count, double share) {
    const auto place = static_cast<std::size_t>(share * static_cast<double>(count));
    return variances[place] * (window - 3) / boost::math::quantile(chi2, share);
  };
  double square = quantile(variances.size(), 0.25);
  const double reach = boost::math::quantile(chi2, 0.999) / (window - 3);
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

// By windows of so many samples of every `apart`-th one; NaN when there are too few.
double NoiseOf(std::span<const SampledColumn> columns, std::size_t apart, int window) {
  std::vector<double> variances;
  for (const SampledColumn& column : columns) {
    std::vector<double> t, v;
    for (std::size_t i = 0; i < column.values.size(); i += apart) {
      if (std::isnan(column.values[i])) continue;
      t.push_back(column.times[i]);
      v.push_back(column.values[i]);
      if (static_cast<int>(t.size()) == window) {
        variances.push_back(WindowVariance(t, v));
        t.clear();
        v.clear();
      }
    }
    if (window == kNoiseWindow && t.size() >= kLeastWindow)
      variances.push_back(WindowVariance(t, v));
  }
  return ScaleOf(std::move(variances), window);
}

// Longer than a flight of a hopper may be: the median over the columns, of the samples that are
// there.
bool IsWindowLong(std::span<const SampledColumn> columns) {
  std::vector<double> steps;
  for (const SampledColumn& column : columns) {
    const auto samples = std::count_if(column.values.begin(), column.values.end(),
                                       [](double v) { return !std::isnan(v); });
    if (samples > 1)
      steps.push_back((column.times.back() - column.times.front()) /
                      static_cast<double>(samples - 1));
  }
  if (steps.empty()) return false;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle * (kNoiseWindow - 1) > kLongWindow;
}

// What the values are written in, or an encoder counts: the smallest step from one to the next,
// where many rest. 0: few do, and the motion hides it.
double DigitOf(std::span<const SampledColumn> columns) {
  constexpr double kManyRest = 0.2;
  double digit = std::numeric_limits<double>::infinity();
  long rests = 0, steps = 0;
  for (const SampledColumn& column : columns)
    for (std::size_t i = 1; i < column.values.size(); ++i) {
      const double step = std::abs(column.values[i] - column.values[i - 1]);
      steps += !std::isnan(step);
      rests += step == 0.0;
      if (step > 0.0) digit = std::min(digit, step);
    }
  const bool many = static_cast<double>(rests) > kManyRest * static_cast<double>(steps);
  return many && std::isfinite(digit) ? digit : 0.0;
}

double ByParabolas(std::span<const SampledColumn> columns) {
  std::size_t apart = IsSmoothed(columns) ? ApartIn(columns) : 1;
  double noise = NoiseOf(columns, apart, kNoiseWindow);
  for (; std::isnan(noise) && apart > 1; noise = NoiseOf(columns, apart, kNoiseWindow)) apart /= 2;
  if (apart > 1 || !IsWindowLong(columns)) return noise;
  const double brief = NoiseOf(columns, 1, kShortWindow);
  return std::isnan(noise) || brief < kClearlyLess * noise ? brief : noise;
}

}  // namespace

double EstimateNoise(std::span<const SampledColumn> columns) {
  const double noise = ByParabolas(columns), digit = DigitOf(columns);
  // What rests within one digit is known no better than that.
  constexpr double kOfDigit = 0.288675;                        // 1/sqrt(12)
  return noise < kOfDigit * digit ? kOfDigit * digit : noise;  // NaN stays
}

}  // namespace hoplab
