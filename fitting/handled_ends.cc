#include "fitting/handled_ends.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hoplab {
namespace {

constexpr double kLook_s = 1.0;      // before the fall, that are looked at
constexpr double kFall_s = 0.25;     // before that depth, within which it begins
constexpr double kDepth = 0.025;     // m, of the fall that is looked at: some 70 ms
constexpr double kShortest = 0.015;  // s, that a body is held
constexpr std::size_t kFewest = 5;   // samples, likewise
constexpr double kWithinStep = 0.1;  // of a sample, how well a release between two is placed
constexpr double kNoise = 2.0;       // standard deviations, rms, by which the path may be missed
constexpr double kBetter = 100.0;    // variances, by which every other path must be worse
constexpr double kRest_s = 0.1, kAtRest_m_per_s = 0.03;
constexpr double kInTheAir_m = 0.01;
constexpr double kOff = 5.0;      // standard deviations, above the ground
constexpr double kLatest = 2.2;   // likewise, rms, by which a free body's latest samples may be off
constexpr std::size_t kKept = 3;  // of the samples until a hand shows, one in so many is kept

// y + fallen(t) = at + rate t, by least squares, t from the first sample on.
struct LineFit {
  double at = 0.0, rate = 0.0;
  double square = std::numeric_limits<double>::infinity();
};
template <class Fallen>
LineFit FitLine(const Samples& s, std::size_t first, std::size_t last, const Fallen& fallen) {
  if (last < first + 3) return {};
  const auto y = [&](std::size_t i) { return s.y[i] + fallen(s.t[i] - s.t[first]); };
  double mean_t = 0.0, mean_y = 0.0, tt = 0.0, ty = 0.0;
  const double n = static_cast<double>(last - first);
  for (std::size_t i = first; i < last; ++i) {
    mean_t += (s.t[i] - s.t[first]) / n;
    mean_y += y(i) / n;
  }
  for (std::size_t i = first; i < last; ++i) {
    const double t = s.t[i] - s.t[first] - mean_t;
    tt += t * t;
    ty += t * (y(i) - mean_y);
  }
  LineFit fit{mean_y - ty / tt * mean_t, ty / tt, 0.0};
  for (std::size_t i = first; i < last; ++i)
    fit.square += std::pow(y(i) - fit.at - fit.rate * (s.t[i] - s.t[first]), 2);
  return fit;
}
LineFit FitRest(const Samples& s, std::size_t first, std::size_t last) {
  return FitLine(s, first, last, [](double) { return 0.0; });
}
// Of a body that nothing holds.
LineFit FitFall(const Samples& s, std::size_t first, std::size_t last, double gravity) {
  return FitLine(s, first, last, [&](double t) { return 0.5 * gravity * t * t; });
}
// Of one that is held, or moved evenly, until `release`, and falls free from there on.
LineFit FitLateFall(const Samples& s, std::size_t first, std::size_t last, double release,
                    double gravity) {
  return FitLine(s, first, last, [&](double t) {
    const double since = std::max(t - release, 0.0);
    return 0.5 * gravity * since * since;
  });
}
// Squares that are left beside the best parabola.
double LeftByParabola(const Samples& s, std::size_t first, std::size_t last) {
  const auto n = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixX3d A(n, 3);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t at = first + static_cast<std::size_t>(i);
    const double t = s.t[at] - s.t[first];
    A.row(i) << 1.0, t, t * t;
    y[i] = s.y[at];
  }
  const Eigen::VectorXd values = A.colPivHouseholderQr().solve(y);
  return (y - A * values).squaredNorm();
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
  const auto since = [&](double before) {
    const auto at = std::lower_bound(s.t.begin(), s.t.end(), s.t[last - 1] - before);
    return static_cast<std::size_t>(at - s.t.begin());
  };
  const std::size_t first = since(kLook_s);
  const auto square_at = [&](double release) {
    return FitLateFall(s, first, last, release, gravity).square;
  };
  double best = std::numeric_limits<double>::infinity(), at = 0.0;
  for (std::size_t i = std::max(first + kFewest, since(kFall_s)); i + kFewest < last; ++i) {
    const double release = s.t[i] - s.t[first];
    if (release < kShortest) continue;
    const double square = square_at(release);
    if (square < best) {
      best = square;
      at = release;
    }
  }
  if (!std::isfinite(best)) return std::nullopt;
  // Within a sample, by the parabola through three times about the best.
  const double h = s.step, before = square_at(at - h), after = square_at(at + h);
  const double bend = before - 2.0 * best + after;
  if (bend > 0.0) at += std::clamp(0.5 * h * (before - after) / bend, -h, h);
  const LineFit late = FitLateFall(s, first, last, at, gravity);
  const double variance = sigma * sigma;
  const double noise = kNoise * kNoise * variance * static_cast<double>(last - first);
  const bool any_other = LeftByParabola(s, first, last) < late.square + kBetter * variance;
  if (!(late.square <= noise) || any_other) return std::nullopt;
  Release found;
  found.time_s = s.t[first] + at;
  found.doubt_s = bend > 0.0 ? h * std::hypot(sigma * std::sqrt(2.0 / bend), kWithinStep) : h;
  found.rise_m = late.rate * (found.time_s - s.t.front());
  while (found.first < s.size() && s.t[found.first] < found.time_s) ++found.first;
  return found;
}

std::optional<std::size_t> FindCatch(const Samples& s, double sigma, double gravity,
                                     double lands_m) {
  // The rest at the end.
  std::size_t rest = s.size();
  while (rest > 0 && s.t.back() - s.t[rest - 1] <= kRest_s) --rest;
  if (s.size() - rest < kFewest || rest < kFewest) return std::nullopt;
  const LineFit held = FitRest(s, rest, s.size());
  const double spread = std::sqrt(held.square / static_cast<double>(s.size() - rest));
  if (spread > kNoise * sigma || std::abs(held.rate) > kAtRest_m_per_s) return std::nullopt;
  if (FitFall(s, rest, s.size(), gravity).square < held.square + kBetter * sigma * sigma)
    return std::nullopt;
  if (held.at < lands_m + kInTheAir_m + kOff * sigma) return std::nullopt;
  // The flight it is in, and how far it is one. Without a stance before nobody knows that it is.
  std::size_t begin = s.size();
  while (begin > 0 && s.y[begin - 1] > lands_m) --begin;
  if (begin == 0) return std::nullopt;
  if (s.size() - begin <= 2 * kFewest) return begin;
  std::size_t free = begin;
  for (std::size_t last = begin + 2 * kFewest; last <= s.size(); ++last) {
    const LineFit path = FitFall(s, begin, last, gravity);
    double square = 0.0;  // of the latest samples
    for (std::size_t i = last - kFewest; i < last; ++i) {
      const double t = s.t[i] - s.t[begin];
      square += std::pow(s.y[i] + 0.5 * gravity * t * t - path.at - path.rate * t, 2);
    }
    if (square > kLatest * kLatest * sigma * sigma * static_cast<double>(kFewest)) break;
    free = last;
  }
  // A hand that begins gently shows late: along the ground before it shows in the height.
  return begin + (free - begin) / kKept;
}

std::optional<std::size_t> FindTopAfterStance(const Samples& heights, bool said, double lands_m,
                                              double doubt, std::size_t fewest) {
  const double begins_below = doubt + (said ? 0.003 : 0.001), deep = said ? 0.015 + doubt : 0.0;
  const std::vector<double>& y = heights.y;
  if (y.empty() || !(y.front() < lands_m - begins_below)) return std::nullopt;
  const auto up = std::find_if(y.begin(), y.end(), [&](double h) { return h > lands_m + doubt; });
  const auto down = std::find_if(up, y.end(), [&](double h) { return h < lands_m; });
  if (up == y.end() || !(*std::min_element(y.begin(), up) < lands_m - deep)) return std::nullopt;
  const auto top = std::max_element(up, down);
  if (static_cast<std::size_t>(y.end() - top) < fewest) return std::nullopt;
  return static_cast<std::size_t>(top - y.begin());
}

}  // namespace hoplab
