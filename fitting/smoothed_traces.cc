#include "fitting/smoothed_traces.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/nan.h"
#include "base/text.h"
#include "model/pose_filter.h"

namespace hoplab {
namespace {

constexpr std::size_t kWindow = 12;   // samples
constexpr std::size_t kWindows = 12;  // fewer tell nothing
constexpr double kFarthest = 0.01;    // s, of two samples that are compared: a stance lasts longer
constexpr double kNotWhite = 0.0;     // white noise has -0.55 +- 0.1

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

}  // namespace

double SmoothnessOfNoise(std::span<const SampledColumn> columns) {
  double step = 0.0;
  for (const SampledColumn& c : columns)
    if (c.times.size() > 1)
      step = std::max(step,
                      (c.times.back() - c.times.front()) / static_cast<double>(c.times.size() - 1));
  double smoothness = kNaN;
  std::vector<Window> windows;
  for (std::size_t stride = 1; stride == 1 || static_cast<double>(stride) * step <= kFarthest;
       stride *= 2) {
    windows.clear();
    for (const SampledColumn& column : columns) AddWindows(column, stride, windows);
    if (windows.empty()) break;
    smoothness = std::fmax(smoothness, MedianOfQuietest(windows));
  }
  return smoothness;
}

std::vector<Channel> SmoothedChannels(const FitProblem& problem) {
  std::vector<Channel> smoothed;
  const std::size_t count = problem.channels.size();
  for (std::size_t c = 0; c < count; ++c) {
    if (!IsFiltered(problem.channels[c].channel)) continue;
    std::vector<std::vector<double>> values;
    std::vector<SampledColumn> columns;
    for (const TrialProblem& t : problem.trials) {
      values.emplace_back();
      for (std::size_t cell = c; cell < t.data.size(); cell += count)
        values.back().push_back(t.data[cell]);
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      columns.push_back({problem.trials[k].row_times, values[k]});
    if (SmoothnessOfNoise(columns) > kNotWhite) smoothed.push_back(problem.channels[c].channel);
  }
  return smoothed;
}

std::vector<std::string> SmoothedTraces(const FitProblem& problem) {
  std::vector<std::string> names;
  for (const Channel c : SmoothedChannels(problem)) names.push_back(ChannelName(c));
  if (names.empty()) return {};
  return {
      Join(names) +
      ": neighbouring samples have the same noise, as a filter leaves it. What it took from the "
      "motion, a simulation must lack, too: export the traces as they were recorded, or fit the "
      "filter "
      "(--with sensor_low_pass; diagnose tries it)"};
}

}  // namespace hoplab
