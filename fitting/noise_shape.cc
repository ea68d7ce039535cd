#include "fitting/noise_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/nan.h"

namespace hoplab {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMostSamples = 24;  // spread over a window
constexpr std::size_t kSideBySide = 8;    // rows in its middle
constexpr std::size_t kFewest = 6;        // windows of a coordinate
constexpr double kLoudest = 6.0;          // times the median window's square: more is no noise
constexpr double kLongest_s = 0.03, kWidest_s = 0.06;  // of filters that are looked for
constexpr int kTimes = 40, kBits = 8;
// What is white beside it, over its variance.
constexpr std::array kRoundings = {1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3,
                                   3e-3, 1e-2, 1e-1, 0.5,  2.0,  10.0};
// But for rounding; a mean's differences are white anyway, and hide some.
constexpr double kMostWhite = 1e-3, kMostWhiteOfMean = 0.05;
// So much white noise, over what is left, is laid over it: no filter is known so well that the last
// thousandth of what it lets through tells of it.
constexpr double kLaidOver = 1e-4;
constexpr double kLeastStrength = 1.3;  // a mean of two has 1.41

// Of a Butterworth filter of order 2 by the bilinear transform: what it answers to one sample.
std::vector<double> AnswerOfButterworth(double time, double step, int samples) {
  const double k = std::tan(std::min(0.5 * step / time, 1.5));
  const double norm = 1.0 / (1.0 + std::numbers::sqrt2 * k + k * k), b = k * k * norm;
  const double a1 = 2.0 * (k * k - 1.0) * norm, a2 = (1.0 - std::numbers::sqrt2 * k + k * k) * norm;
  std::vector<double> y;
  for (int i = 0; i < samples; ++i) {
    double next = i == 0 || i == 2 ? b : i == 1 ? 2.0 * b : 0.0;
    if (i > 0) next -= a1 * y[static_cast<std::size_t>(i) - 1];
    if (i > 1) next -= a2 * y[static_cast<std::size_t>(i) - 2];
    y.push_back(next);
  }
  return y;
}

// Sum of the products of samples `lag` apart.
double ProductAt(const std::vector<double>& y, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = lag; i < y.size(); ++i) sum += y[i] * y[i - lag];
  return sum;
}

// What is left of every coordinate's windows beside parabolas.
struct LeftAtTops {
  std::vector<std::size_t> rows;  // of a window that are looked at
  std::size_t shifts = 1;         // by which they may move within it
  MatrixXd beside;                // an orthonormal basis of what is no parabola, a column each
  struct Coordinate {
    MatrixXd square;  // mean of the products of what is left, in that basis
    std::size_t windows = 0;
    double digit = std::numeric_limits<double>::infinity();  // in which it is written [m]
  };
  std::vector<Coordinate> of;

  Index samples() const { return static_cast<Index>(rows.size()); }
  int lags() const { return static_cast<int>(rows.back()) + 1; }
};

// Spread over the window, which tells of slow noise, and side by side in its middle.
std::vector<std::size_t> RowsLookedAt(std::size_t all, std::size_t stride) {
  std::vector<std::size_t> rows;
  const std::size_t middle = all / 2;
  for (std::size_t row = 0; row + stride <= all; ++row)
    if (row % stride == 0 || (row >= middle && row < middle + kSideBySide)) rows.push_back(row);
  return rows;
}

MatrixXd BesideParabolas(const std::vector<std::size_t>& rows) {
  const auto n = static_cast<Index>(rows.size());
  MatrixXd powers(n, 3);
  for (Index i = 0; i < n; ++i) {
    const double s = 2.0 * static_cast<double>(rows[static_cast<std::size_t>(i)]) /
                         static_cast<double>(rows.back()) -
                     1.0;
    powers.row(i) << 1.0, s, s * s;
  }
  const MatrixXd q = powers.householderQr().householderQ();
  return q.rightCols(n - 3);
}

// The first of the window's shifted samples of which none is missing; empty: there are none.
VectorXd WholeWindow(std::span<const double> column, const LeftAtTops& left) {
  VectorXd window(left.samples());
  for (std::size_t shift = 0; shift < left.shifts; ++shift) {
    for (Index k = 0; k < window.size(); ++k)
      window[k] = column[shift + left.rows[static_cast<std::size_t>(k)]];
    if (window.allFinite()) return window;
  }
  return {};
}

LeftAtTops::Coordinate LookAt(std::span<const PlaceTrace> traces, const FlightTops& tops,
                              std::vector<double> PlaceTrace::*coordinate, const LeftAtTops& left) {
  LeftAtTops::Coordinate seen;
  std::vector<VectorXd> windows;
  std::vector<double> squares;
  for (const FlightTops::Top& top : tops.found) {
    const std::span<const double> column(traces[top.trial].*coordinate);
    if (column.empty()) continue;
    const VectorXd window = WholeWindow(column.subspan(top.first, tops.rows()), left);
    if (window.size() == 0) continue;
    for (Index k = 1; k < window.size(); ++k)
      if (window[k] != window[k - 1])
        seen.digit = std::min(seen.digit, std::abs(window[k] - window[k - 1]));
    windows.push_back(left.beside.transpose() * window);
    squares.push_back(windows.back().squaredNorm());
  }
  if (windows.size() < kFewest) return seen;
  std::vector<double> sorted = squares;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  // A coordinate that does not move has no noise.
  constexpr double kNothing = 1e-12;  // m
  if (!(*middle > kNothing * kNothing)) return seen;
  seen.square = MatrixXd::Zero(left.beside.cols(), left.beside.cols());
  for (std::size_t i = 0; i < windows.size(); ++i) {
    if (squares[i] > kLoudest * *middle) continue;
    seen.square += windows[i] * windows[i].transpose();
    ++seen.windows;
  }
  seen.square /= static_cast<double>(seen.windows);
  const double mean = seen.square.trace() / static_cast<double>(seen.square.cols());
  seen.square.diagonal().array() += kLaidOver * mean;
  return seen;
}

// With as many samples as a window may have, or, where so many are hardly ever whole, half of them.
LeftAtTops LookAtTops(std::span<const PlaceTrace> traces, const FlightTops& tops,
                      std::size_t most) {
  LeftAtTops left;
  left.shifts = std::max<std::size_t>(1, tops.rows() / most);
  left.rows = RowsLookedAt(tops.rows(), left.shifts);
  left.beside = BesideParabolas(left.rows);
  for (std::vector<double> PlaceTrace::*coordinate : {&PlaceTrace::x, &PlaceTrace::y})
    left.of.push_back(LookAt(traces, tops, coordinate, left));
  return left;
}

bool Tells(const LeftAtTops& left) {
  return std::any_of(left.of.begin(), left.of.end(),
                     [](const auto& coordinate) { return coordinate.windows > 0; });
}

// How likely what is left is as such noise, each coordinate of its own size; and those sizes.
struct Likelihood {
  double log = -std::numeric_limits<double>::infinity();
  std::vector<double> sigma = {};
};
Likelihood LikelihoodOf(const LeftAtTops& left, const FilteredWhite& noise, double rounding) {
  MatrixXd covariance(left.samples(), left.samples());
  for (std::size_t i = 0; i < left.rows.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
      covariance(a, b) = covariance(b, a) = noise.correlation[left.rows[i] - left.rows[j]];
    }
  covariance.diagonal().array() += rounding;
  const Eigen::LLT<MatrixXd> root(left.beside.transpose() * covariance * left.beside);
  Likelihood likelihood;
  if (root.info() != Eigen::Success) return likelihood;
  const double half_log = root.matrixLLT().diagonal().array().log().sum();
  const auto freedom = static_cast<double>(left.beside.cols());
  double log = 0.0;
  for (const auto& coordinate : left.of) {
    likelihood.sigma.push_back(kNaN);
    if (coordinate.windows == 0) continue;
    const double square = root.solve(coordinate.square).trace() / freedom;
    log -= static_cast<double>(coordinate.windows) * (0.5 * freedom * std::log(square) + half_log);
    likelihood.sigma.back() = std::sqrt(square);
  }
  if (std::isfinite(log)) likelihood.log = log;
  return likelihood;
}

// The likeliest of such filters by its time, and by how much of it is rounded or white.
class TimeSearch {
 public:
  TimeSearch(const LeftAtTops& left, RecordFilter filter, double step)
      : left_(left), filter_(filter), step_(step) {}

  // How likely the likeliest of a few such filters is: a search that is not worth while is left
  // out.
  double LogOfAFew() {
    constexpr std::array kFew = {1e-4, 1e-2};
    const double longest = filter_ == RecordFilter::kMovingAverage ? kWidest_s : kLongest_s;
    for (double time = 1.4 * step_; time < longest; time *= 1.5) Try(time, kFew);
    return log();
  }

  NoiseShape Run() {
    if (filter_ == RecordFilter::kMovingAverage) {
      // Of whole numbers of samples.
      for (int n = 2; n * step_ <= kWidest_s; ++n) Try(n * step_, kRoundings);
      return best_;
    }
    const double first = 0.3 * step_, ratio = std::pow(kLongest_s / first, 1.0 / (kTimes - 1));
    double time = first;
    for (int k = 0; k < kTimes; ++k, time *= ratio) Try(time, kRoundings);
    if (!(log() > -std::numeric_limits<double>::infinity())) return best_;
    // Between its neighbours; how much is rounded goes along.
    time = best_.time;
    const double rounding = best_.white;
    boost::math::tools::brent_find_minima(
        [&](double log_time) {
          const double t = std::exp(log_time);
          const FilteredWhite noise = FilterWhite(filter_, t, step_, left_.lags());
          const auto found = boost::math::tools::brent_find_minima(
              [&](double log_rounding) { return -TryOne(t, noise, std::exp(log_rounding)); },
              std::log(0.2 * rounding), std::log(5.0 * rounding), kBits);
          return found.second;
        },
        std::log(time / ratio), std::log(time * ratio), kBits);
    return best_;
  }

 private:
  double log() const { return best_.better_by; }
  void Try(double time, std::span<const double> roundings) {
    const FilteredWhite noise = FilterWhite(filter_, time, step_, left_.lags());
    for (const double rounding : roundings) TryOne(time, noise, rounding);
  }
  // How likely it is; kept where it is the likeliest so far.
  double TryOne(double time, const FilteredWhite& noise, double rounding) {
    const Likelihood likelihood = LikelihoodOf(left_, noise, rounding);
    if (likelihood.log > log())
      best_ = {filter_, time, noise.strength, rounding, likelihood.log, likelihood.sigma};
    return likelihood.log;
  }

  const LeftAtTops& left_;
  RecordFilter filter_;
  double step_;
  NoiseShape best_{.better_by = -std::numeric_limits<double>::infinity()};
};

// A filter lets no noise of the sensor through as it was: what is white comes of rounding. Else it
// is white noise beside a motion that is no parabola.
bool HasNoWhiteNoise(const NoiseShape& noise, const LeftAtTops& left) {
  const double most = noise.filter == RecordFilter::kMovingAverage ? kMostWhiteOfMean : kMostWhite;
  for (std::size_t k = 0; k < left.of.size(); ++k) {
    if (left.of[k].windows == 0) continue;
    const double square = noise.sigma[k] * noise.sigma[k], digit = left.of[k].digit;
    if (noise.white * square > std::max(most * square, 0.25 * digit * digit)) return false;
  }
  return true;
}

}  // namespace

FilteredWhite FilterWhite(RecordFilter filter, double time, double step, int lags) {
  FilteredWhite noise;
  noise.correlation.assign(static_cast<std::size_t>(lags), 0.0);
  const auto fill = [&](const auto& at) {
    for (int k = 0; k < lags; ++k) noise.correlation[static_cast<std::size_t>(k)] = at(k);
  };
  if (filter == RecordFilter::kNone) {
    fill([](int k) { return k == 0 ? 1.0 : 0.0; });
  } else if (filter == RecordFilter::kFirstOrder) {
    const double alike = std::exp(-step / time);
    fill([&](int k) { return std::pow(alike, k); });
    noise.strength = std::sqrt((1.0 + alike) / (1.0 - alike));
  } else if (filter == RecordFilter::kMovingAverage) {
    const double samples = std::max(1.0, time / step);
    fill([&](int k) { return std::max(0.0, 1.0 - k / samples); });
    noise.strength = std::sqrt(samples);
  } else {
    // Beyond some fifty of its times nothing of the answer is left.
    const int reach = std::min(2 * lags + static_cast<int>(50.0 * time / step), 4000);
    std::vector<double> answer = AnswerOfButterworth(time, step, reach);
    if (filter == RecordFilter::kTwoPass) {
      // To and fro: the answer is what the first one has in common with itself.
      std::vector<double> both;
      for (int k = -reach / 2; k <= reach / 2; ++k)
        both.push_back(ProductAt(answer, static_cast<std::size_t>(std::abs(k))));
      answer = both;
    }
    const double square = ProductAt(answer, 0);
    fill([&](int k) { return ProductAt(answer, static_cast<std::size_t>(k)) / square; });
    noise.strength = 1.0 / std::sqrt(square);  // what is slow goes through as it is
  }
  return noise;
}

NoiseShape FindNoiseShape(std::span<const PlaceTrace> traces, const FlightTops& tops) {
  NoiseShape white;
  if (tops.found.size() < kFewest) return white;
  LeftAtTops left = LookAtTops(traces, tops, kMostSamples);
  if (!Tells(left)) left = LookAtTops(traces, tops, kMostSamples / 2);
  if (!Tells(left)) return white;
  const Likelihood plain =
      LikelihoodOf(left, FilterWhite(RecordFilter::kNone, 0.0, tops.step, left.lags()), 0.0);
  white.sigma = plain.sigma;
  constexpr std::array kFilters = {RecordFilter::kTwoPass, RecordFilter::kOnePass,
                                   RecordFilter::kMovingAverage};
  const auto search = [&](RecordFilter filter) { return TimeSearch(left, filter, tops.step); };
  const auto may_be = [&](RecordFilter filter) { return search(filter).LogOfAFew() > plain.log; };
  if (!may_be(RecordFilter::kFirstOrder) &&
      std::none_of(kFilters.begin(), kFilters.end(), may_be)) {
    return white;
  }
  // Noise is often alike in neighbours as of first order, without a filter: that is ruled out.
  NoiseShape best = search(RecordFilter::kFirstOrder).Run();
  if (!(best.better_by > plain.log + kSurelyBetter)) {
    best = white;
    best.better_by = plain.log;
  }
  const double without_filter = std::max(plain.log, best.better_by);
  for (const RecordFilter filter : kFilters) {
    const NoiseShape found = search(filter).Run();
    if (found.better_by > std::max(best.better_by, without_filter + kSurelyBetter)) best = found;
  }
  best.better_by -= plain.log;
  const bool as_is = best.filter == RecordFilter::kFirstOrder || HasNoWhiteNoise(best, left);
  return as_is && best.strength > kLeastStrength ? best : white;
}

}  // namespace hoplab
