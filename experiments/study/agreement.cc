#include "experiments/study/agreement.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/statistics/bivariate_statistics.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/nan.h"

namespace hoplab {
namespace {

constexpr std::size_t kFewestPairs = 3;

using Columns = std::pair<std::vector<double>, std::vector<double>>;

Columns CompletePairs(std::span<const double> a, std::span<const double> b) {
  HOPLAB_CHECK(a.size() == b.size());
  Columns pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    pairs.first.push_back(a[i]);
    pairs.second.push_back(b[i]);
  }
  return pairs;
}

// 1 for the smallest; equal values share the mean of their places.
std::vector<double> MeanRanks(const std::vector<double>& values) {
  std::vector<double> ranks;
  for (const double value : values) {
    double below = 0.0, equal = 0.0;
    for (const double other : values) {
      below += other < value ? 1.0 : 0.0;
      equal += other == value ? 1.0 : 0.0;
    }
    ranks.push_back(below + 0.5 * (equal + 1.0));
  }
  return ranks;
}

bool IsConstant(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&](double v) { return v == values[0]; });
}

// Sums over the groups of equal values, t values in each, of t(t-1), t(t-1)(t-2), t(t-1)(2t+5).
struct TieSums {
  double pairs = 0.0, triples = 0.0, variance = 0.0;
};
TieSums TieSumsOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  TieSums sums;
  for (auto begin = values.begin(); begin != values.end();) {
    const auto end = std::upper_bound(begin, values.end(), *begin);
    const auto t = static_cast<double>(end - begin);
    sums.pairs += t * (t - 1.0);
    sums.triples += t * (t - 1.0) * (t - 2.0);
    sums.variance += t * (t - 1.0) * (2.0 * t + 5.0);
    begin = end;
  }
  return sums;
}

double Sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

}  // namespace

Agreement AgreementOf(std::span<const double> published, std::span<const double> ours) {
  const auto [p, o] = CompletePairs(published, ours);
  Agreement agreement{static_cast<int>(p.size()), kNaN, kNaN, kNaN};
  if (p.empty()) return agreement;
  const auto n = static_cast<double>(p.size());
  double square = 0.0;
  agreement.max_abs = agreement.mean = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double difference = o[i] - p[i];
    square += difference * difference;
    agreement.mean += difference / n;
    agreement.max_abs = std::max(agreement.max_abs, std::abs(difference));
  }
  agreement.rms = std::sqrt(square / n);
  return agreement;
}

double RankCorrelation(std::span<const double> a, std::span<const double> b) {
  const auto [x, y] = CompletePairs(a, b);
  if (x.size() < kFewestPairs || IsConstant(x) || IsConstant(y)) return kNaN;
  return boost::math::statistics::correlation_coefficient(MeanRanks(x), MeanRanks(y));
}

Trend TrendOf(std::span<const double> a, std::span<const double> b) {
  const auto [x, y] = CompletePairs(a, b);
  if (x.size() < kFewestPairs || IsConstant(x)) return {kNaN, kNaN};
  if (IsConstant(y)) return {0.0, 1.0};
  double s = 0.0;  // concordant less discordant pairs
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) s += Sign(x[i] - x[j]) * Sign(y[i] - y[j]);
  }
  const TieSums u = TieSumsOf(x), v = TieSumsOf(y);
  const auto n = static_cast<double>(x.size());
  const double all = n * (n - 1.0);
  // Kendall, Rank Correlation Methods, ch. 4.
  const double variance = (all * (2.0 * n + 5.0) - u.variance - v.variance) / 18.0 +
                          u.triples * v.triples / (9.0 * all * (n - 2.0)) +
                          u.pairs * v.pairs / (2.0 * all);
  const double z = Sign(s) * std::max(std::abs(s) - 1.0, 0.0) / std::sqrt(variance);
  const boost::math::normal standard;
  return {2.0 * s / std::sqrt((all - u.pairs) * (all - v.pairs)),
          2.0 * boost::math::cdf(boost::math::complement(standard, std::abs(z)))};
}

}  // namespace hoplab
