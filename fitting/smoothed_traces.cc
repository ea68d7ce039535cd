#include "fitting/smoothed_traces.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "datasets/smoothness.h"
#include "model/pose_filter.h"

namespace hoplab {
namespace {

constexpr double kHardlyWhite = -0.2;

}  // namespace

std::vector<Channel> SmoothedChannels(const FitProblem& problem) {
  // A pitch may be known so well that its differences are those of the motion, and so may one of
  // the two coordinates: both have to look alike.
  std::vector<Channel> smoothed;
  double least = 1.0, most = -1.0;
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    if (!IsFiltered(problem.channels[c].channel)) continue;
    smoothed.push_back(problem.channels[c].channel);
    if (smoothed.back() == Channel::kBodyPitch) continue;
    const std::vector<std::vector<double>> samples = SamplesOf(problem, c);
    std::vector<SampledColumn> columns;
    for (std::size_t i = 0; i < samples.size(); ++i)
      columns.push_back({problem.trials[i].row_times, samples[i]});
    const double smoothness = SmoothnessOfNoise(columns);
    if (std::isnan(smoothness)) return {};
    least = std::min(least, smoothness);
    most = std::max(most, smoothness);
  }
  if (least < kHardlyWhite || most < 0.0) return {};
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
      "filter (--with sensor_low_pass; diagnose tries it)"};
}

}  // namespace hoplab
