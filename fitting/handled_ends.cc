#include "fitting/handled_ends.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hoplab {
namespace {

constexpr double kDepth = 0.025;     // m, of the fall that is looked at: some 70 ms
constexpr double kShortest = 0.015;  // s, that a body is held
constexpr std::size_t kFewest = 5;   // samples, likewise
constexpr double kWithinStep = 0.1;  // of a sample, how well a release between two is placed
constexpr double kNoise = 2.0;       // standard deviations, rms, by which the path may be missed
constexpr double kBetter = 100.0;    // variances, by which every other path must be worse
constexpr double kRest_s = 0.1, kAtRest_m_per_s = 0.03;
constexpr double kInTheAir_m = 0.003;
constexpr double kOff = 5.0;      // standard deviations, above the ground
constexpr double kLatest = 2.2;   // likewise, rms, by which a free body's latest samples may be off
constexpr std::size_t kKept = 3;  // of the samples until a hand shows, one in so many is kept

struct LeastSquares {
  Eigen::VectorXd values;
  double square = std::numeric_limits<double>::infinity();
};
// y = sum of columns(t) times values, of samples [first, last).
template <class Columns>
LeastSquares Fit(const Samples& s, std::size_t first, std::size_t last, int count,
                 const Columns& columns) {
  const auto n = static_cast<Eigen::Index>(last - first);
  if (n <= count) return {};
  Eigen::MatrixXd A(n, count);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t at = first + static_cast<std::size_t>(i);
    columns(s.t[at] - s.t[first], A.row(i));
    y[i] = s.y[at];
  }
  LeastSquares fit;
  fit.values = A.colPivHouseholderQr().solve(y);
  fit.square = (y - A * fit.values).squaredNorm();
  return fit;
}
using Row = Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>>;

LeastSquares Line(const Samples& s, std::size_t first, std::size_t last) {
  return Fit(s, first, last, 2, [](double t, Row row) { row << 1.0, t; });
}
LeastSquares Parabola(const Samples& s, std::size_t first, std::size_t last) {
  return Fit(s, first, last, 3, [](double t, Row row) { row << 1.0, t, 0.5 * t * t; });
}
// Of a body that nothing holds, as a line beside its parabola.
LeastSquares FreeFall(Samples s, std::size_t first, std::size_t last, double gravity) {
  for (std::size_t i = first; i < last; ++i)
    s.y[i] += 0.5 * gravity * std::pow(s.t[i] - s.t[first], 2);
  return Line(s, first, last);
}
// Of a body that is held, or moved evenly, until `release`, and falls free from there on.
LeastSquares LateFall(Samples s, std::size_t last, double release, double gravity) {
  for (std::size_t i = 0; i < last; ++i)
    s.y[i] += 0.5 * gravity * std::pow(std::max(s.t[i] - s.t[0] - release, 0.0), 2);
  return Line(s, 0, last);
}

// How many samples there are until the body is well below where it began.
std::size_t Deep(const Samples& s) {
  const double begins = s.y.front();
  std::size_t below = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    below = s.y[i] < begins - kDepth ? below + 1 : 0;
    if (below == 3) return i + 1;  // no stray one
  }
  return 0;
}

}  // namespace

std::optional<Release> FindRelease(const Samples& s, double sigma, double gravity) {
  const std::size_t last = Deep(s);
  if (last < 2 * kFewest) return std::nullopt;
  double best = std::numeric_limits<double>::infinity(), at = 0.0;
  for (std::size_t i = kFewest; i + kFewest < last; ++i) {
    const double release = s.t[i] - s.t[0];
    if (release < kShortest) continue;
    const double square = LateFall(s, last, release, gravity).square;
    if (square < best) {
      best = square;
      at = release;
    }
  }
  if (!std::isfinite(best)) return std::nullopt;
  const auto square_at = [&](double release) { return LateFall(s, last, release, gravity).square; };
  // Within a sample, by the parabola through three times about the best.
  const double h = s.step, before = square_at(at - h), after = square_at(at + h);
  const double bend = before - 2.0 * best + after;
  if (bend > 0.0) at += std::clamp(0.5 * h * (before - after) / bend, -h, h);
  const LeastSquares late = LateFall(s, last, at, gravity);
  const double variance = sigma * sigma;
  const bool fits = late.square <= kNoise * kNoise * variance * static_cast<double>(last);
  const bool any_other = Parabola(s, 0, last).square < late.square + kBetter * variance;
  if (!fits || any_other) return std::nullopt;
  Release found;
  found.time_s = s.t[0] + at;
  found.doubt_s = bend > 0.0 ? h * std::hypot(sigma * std::sqrt(2.0 / bend), kWithinStep) : h;
  found.height_m = late.values[0] + late.values[1] * at;
  found.speed_m_per_s = late.values[1];
  while (found.first < s.size() && s.t[found.first] < found.time_s) ++found.first;
  return found;
}

std::optional<std::size_t> FindCatch(const Samples& s, double sigma, double gravity,
                                     double lands_m) {
  // The rest at the end.
  std::size_t rest = s.size();
  while (rest > 0 && s.t.back() - s.t[rest - 1] <= kRest_s) --rest;
  if (s.size() - rest < kFewest || rest < kFewest) return std::nullopt;
  const LeastSquares held = Line(s, rest, s.size());
  const double spread = std::sqrt(held.square / static_cast<double>(s.size() - rest));
  if (spread > kNoise * sigma || std::abs(held.values[1]) > kAtRest_m_per_s) return std::nullopt;
  const LeastSquares falls = FreeFall(s, rest, s.size(), gravity);
  if (falls.square < held.square + kBetter * sigma * sigma) return std::nullopt;
  if (held.values[0] < lands_m + kInTheAir_m + kOff * sigma) return std::nullopt;
  // The flight it is in, and how far it is one.
  std::size_t begin = s.size();
  while (begin > 0 && s.y[begin - 1] > lands_m) --begin;
  if (s.size() - begin <= 2 * kFewest) return begin;
  std::size_t free = begin;
  for (std::size_t last = begin + 2 * kFewest; last <= s.size(); ++last) {
    const LeastSquares path = FreeFall(s, begin, last, gravity);
    double square = 0.0;  // of the latest samples
    for (std::size_t i = last - kFewest; i < last; ++i) {
      const double t = s.t[i] - s.t[begin];
      square += std::pow(s.y[i] + 0.5 * gravity * t * t - path.values[0] - path.values[1] * t, 2);
    }
    if (square > kLatest * kLatest * sigma * sigma * static_cast<double>(kFewest)) break;
    free = last;
  }
  // A hand that begins gently shows late: along the ground before it shows in the height.
  return begin + (free - begin) / kKept;
}

}  // namespace hoplab
