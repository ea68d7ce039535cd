#include "fitting/smoothed_traces.h"

#include <vector>

#include "base/text.h"
#include "datasets/smoothness.h"
#include "model/pose_filter.h"

namespace hoplab {

std::vector<Channel> SmoothedChannels(const FitProblem& problem) {
  // A pitch may be known so well that its differences are those of the motion.
  std::vector<Channel> smoothed;
  std::vector<double> smoothness;
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    if (!IsFiltered(problem.channels[c].channel)) continue;
    smoothed.push_back(problem.channels[c].channel);
    if (smoothed.back() == Channel::kBodyPitch) continue;
    const std::vector<std::vector<double>> samples = SamplesOf(problem, c);
    std::vector<SampledColumn> columns;
    for (std::size_t i = 0; i < samples.size(); ++i)
      columns.push_back({problem.trials[i].row_times, samples[i]});
    smoothness.push_back(SmoothnessOfNoise(columns));
  }
  return AreSmoothed(smoothness) ? smoothed : std::vector<Channel>();
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
