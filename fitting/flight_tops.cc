#include "fitting/flight_tops.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "datasets/smoothness.h"

namespace hoplab {
namespace {

constexpr std::size_t kFewestTops = 6;
constexpr std::size_t kBeyond = 3;                   // strides on either side of a window
constexpr double kMostWhite = -0.4;                  // white noise has -0.61 +- 0.07
constexpr double kLeastDrop = 0.7, kMostDrop = 1.3;  // of a free fall's

double StepOfMost(std::span<const PlaceTrace> traces) {
  std::vector<double> steps;
  for (const PlaceTrace& trace : traces)
    if (trace.times.size() > 1) steps.push_back(UsualStep(trace.times));
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

bool IsWhole(std::span<const double> values) {
  return std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
}

// Rows from one end of what is looked at to the other, and their middle.
struct Reach {
  std::size_t length, half;
};

bool IsTop(const PlaceTrace& trace, const FlightTops& tops, const Reach& reach, std::size_t first) {
  const std::span<const double> heights = trace.y.subspan(first, reach.length + 1);
  const double top = trace.y[first + reach.half];
  if (!IsWhole(heights) || *std::max_element(heights.begin(), heights.end()) != top) return false;
  if (!trace.x.empty() && !IsWhole(trace.x.subspan(first, reach.length + 1))) return false;
  const double time = trace.times[first + reach.length] - trace.times[first];
  if (std::abs(time - static_cast<double>(reach.length) * tops.step) > 0.5 * tops.step)
    return false;  // a gap
  const double drop =
      (top - 0.5 * (heights.front() + heights.back())) / (0.125 * trace.gravity * time * time);
  return drop > kLeastDrop && drop < kMostDrop;
}

// Sum of the products of neighbouring third differences, over that of their squares.
double CorrelationOf(const FlightTops& tops, std::span<const PlaceTrace> traces,
                     std::span<const double> PlaceTrace::*column) {
  double square = 0.0, product = 0.0;
  for (const FlightTops::Top& top : tops.found) {
    const Eigen::VectorXd y = tops.Window(top, traces[top.trial].*column);
    double before = 0.0;
    for (Eigen::Index i = 3; i < y.size(); ++i) {
      const double third = y[i] - 3.0 * y[i - 1] + 3.0 * y[i - 2] - y[i - 3];
      square += third * third;
      product += third * before;
      before = third;
    }
  }
  return product / square;
}

}  // namespace

Eigen::VectorXd FlightTops::Window(const Top& top, std::span<const double> column) const {
  Eigen::VectorXd window(kSamples);
  for (int k = 0; k < kSamples; ++k)
    window[k] = column[top.first + static_cast<std::size_t>(k) * stride];
  return window;
}

FlightTops FindFlightTops(std::span<const PlaceTrace> traces) {
  FlightTops tops;
  tops.step = StepOfMost(traces);
  if (!(tops.step > 0.0)) return tops;
  tops.stride = RowsApart(tops.step);
  const std::size_t length = (FlightTops::kSamples - 1 + 2 * kBeyond) * tops.stride;
  const Reach reach{length, length / 2};
  for (std::size_t i = 0; i < traces.size(); ++i) {
    for (std::size_t first = 0; first + length < traces[i].y.size(); ++first) {
      if (!IsTop(traces[i], tops, reach, first)) continue;
      tops.found.push_back({i, first + kBeyond * tops.stride});
      first += reach.half;
    }
  }
  return tops;
}

double FilterTimeOf(std::span<const PlaceTrace> traces, const FlightTops& tops) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (tops.found.size() < kFewestTops) return kNone;
  std::vector<double> smoothness, at_tops;
  double tau = kNone;
  for (std::span<const double> PlaceTrace::*coordinate : {&PlaceTrace::x, &PlaceTrace::y}) {
    std::vector<SampledColumn> columns;
    for (const PlaceTrace& trace : traces)
      if (!(trace.*coordinate).empty()) columns.push_back({trace.times, trace.*coordinate});
    if (columns.size() < traces.size()) continue;
    smoothness.push_back(SmoothnessOfNoise(columns));
    at_tops.push_back(CorrelationOf(tops, traces, coordinate));
    // Where the motion of a stance is left in it, noise looks slower than it is.
    tau = std::fmin(tau, FilterTimeOf(columns));
  }
  const double mean =
      std::accumulate(at_tops.begin(), at_tops.end(), 0.0) / static_cast<double>(at_tops.size());
  return AreSmoothed(smoothness) && mean > kMostWhite ? tau : kNone;
}

}  // namespace hoplab
