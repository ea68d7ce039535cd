#include "fitting/flight_tops.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/nan.h"
#include "datasets/smoothness.h"

namespace hoplab {
namespace {

constexpr std::size_t kBeyond = 3;                   // strides on either side of a window
constexpr double kLeastDrop = 0.7, kMostDrop = 1.3;  // of a free fall's

// From row to row in the mean, gaps left out: stamps may be rounded.
double MeanStep(const std::vector<double>& times) {
  const double most = 1.5 * UsualStep(times);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] - times[i - 1] > most) continue;
    sum += times[i] - times[i - 1];
    ++count;
  }
  return sum / count;
}

double StepOfMost(const std::vector<PlaceTrace>& traces) {
  std::vector<double> steps;
  for (const PlaceTrace& trace : traces)
    if (trace.times.size() > 1) steps.push_back(MeanStep(trace.times));
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

// Rows that are not there become rows that say nothing.
void FillGaps(PlaceTrace& trace, double step) {
  constexpr double kGap = 1.5, kLongest_s = 0.1;  // a longer one is in no window
  PlaceTrace even{.gravity = trace.gravity};
  for (std::size_t row = 0; row < trace.times.size(); ++row) {
    const double gap = row == 0 ? 0.0 : trace.times[row] - trace.times[row - 1];
    const bool is_filled = gap > kGap * step && gap < kLongest_s;
    const int missing = is_filled ? static_cast<int>(std::lround(gap / step)) - 1 : 0;
    for (int k = 1; k <= missing; ++k) {
      even.times.push_back(trace.times[row - 1] + gap * k / (missing + 1));
      even.y.push_back(kNaN);
      if (!trace.x.empty()) even.x.push_back(kNaN);
    }
    even.times.push_back(trace.times[row]);
    even.y.push_back(trace.y[row]);
    if (!trace.x.empty()) even.x.push_back(trace.x[row]);
  }
  trace = std::move(even);
}

// Rows from one end of what is looked at to the other, and their middle.
struct Reach {
  std::size_t length, half;
};

bool IsTop(const PlaceTrace& trace, const FlightTops& tops, const Reach& reach, std::size_t first) {
  const std::span<const double> heights = std::span(trace.y).subspan(first, reach.length + 1);
  const double top = heights[reach.half];
  // Not where it, or an end, is missing.
  if (std::isnan(top) ||
      std::any_of(heights.begin(), heights.end(), [top](double y) { return y > top; }))
    return false;
  const double time = trace.times[first + reach.length] - trace.times[first];
  if (std::abs(time - static_cast<double>(reach.length) * tops.step) > 0.5 * tops.step)
    return false;
  const double drop =
      (top - 0.5 * (heights.front() + heights.back())) / (0.125 * trace.gravity * time * time);
  return drop > kLeastDrop && drop < kMostDrop;
}

}  // namespace

FlightTops FindFlightTops(std::vector<PlaceTrace>& traces) {
  FlightTops tops;
  tops.step = StepOfMost(traces);
  if (!(tops.step > 0.0)) return tops;
  tops.stride = RowsApart(tops.step);
  for (PlaceTrace& trace : traces)
    if (!trace.y.empty()) FillGaps(trace, tops.step);
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

}  // namespace hoplab
