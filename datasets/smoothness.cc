#include "datasets/smoothness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/nan.h"

namespace hoplab {
namespace {

constexpr std::size_t kWindow = 12;   // samples
constexpr std::size_t kWindows = 12;  // fewer tell nothing
// At 50 Hz the third differences are those of the motion.
constexpr double kCoarsest_s = 0.0105;
constexpr double kNotWhite = 0.0;  // white noise has -0.55 +- 0.1
constexpr double kHardlyWhite = -0.2;

struct Window {
  double square, correlation;
};

// Of every `stride`-th sample, whatever their times: a gap makes a window loud, and it is left out.
void AddWindows(const SampledColumn& column, std::size_t stride, std::vector<Window>& windows) {
  const std::size_t length = kWindow * stride;
  for (std::size_t begin = 0; begin + length <= column.values.size(); begin += length) {
    double square = 0.0, product = 0.0, before = 0.0;
    for (std::size_t i = 3; i < kWindow; ++i) {
      const auto y = [&](std::size_t back) { return column.values[begin + (i - back) * stride]; };
      const double third = y(0) - 3.0 * y(1) + 3.0 * y(2) - y(3);
      square += third * third;
      product += third * before;
      before = third;
    }
    if (square > 0.0) windows.push_back({square, product / square});  // NaN: a sample is missing
  }
}

double MedianOfQuietest(std::vector<Window>& windows) {
  if (windows.size() < kWindows) return kNaN;
  const auto middle = windows.begin() + static_cast<std::ptrdiff_t>(windows.size() / 2);
  std::nth_element(windows.begin(), middle, windows.end(),
                   [](const Window& a, const Window& b) { return a.square < b.square; });
  const auto quarter = windows.begin() + static_cast<std::ptrdiff_t>(windows.size() / 4);
  std::nth_element(windows.begin(), quarter, middle,
                   [](const Window& a, const Window& b) { return a.correlation < b.correlation; });
  return quarter->correlation;
}

// Of third differences of samples so many apart.
double CorrelationAt(std::span<const SampledColumn> columns, std::size_t stride) {
  std::vector<Window> windows;
  for (const SampledColumn& column : columns) AddWindows(column, stride, windows);
  return MedianOfQuietest(windows);
}

double Middle(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Of the coarsest column.
double StepOf(std::span<const SampledColumn> columns) {
  double step = 0.0;
  for (const SampledColumn& c : columns) step = std::max(step, UsualStep(c.times));
  return step;
}

}  // namespace

double UsualStep(std::span<const double> times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return steps.empty() ? 0.0 : Middle(steps);
}

double SmoothnessOfNoise(std::span<const SampledColumn> columns) {
  const double step = StepOf(columns);
  if (!(step > 0.0 && step <= kCoarsest_s)) return kNaN;
  double smoothness = kNaN;
  for (std::size_t stride = 1; stride <= RowsApart(step); stride *= 2)
    smoothness = std::fmax(smoothness, CorrelationAt(columns, stride));
  return smoothness;
}

bool IsSmoothed(std::span<const SampledColumn> columns) {
  return SmoothnessOfNoise(columns) > kNotWhite;
}

bool AreSmoothed(std::span<const double> smoothness) {
  if (smoothness.empty()) return false;
  const auto [least, most] = std::minmax_element(smoothness.begin(), smoothness.end());
  return *least >= kHardlyWhite && *most >= kNotWhite;  // not where one is NaN
}

std::size_t RowsApart(double step) {
  constexpr double kRounding = 1.0 + 1e-6;
  return step > 0.0 && step < kApart_s ? static_cast<std::size_t>(kRounding * kApart_s / step) : 1;
}

std::size_t ApartIn(std::span<const SampledColumn> columns) { return RowsApart(StepOf(columns)); }

}  // namespace hoplab
