#include "fitting/smoothed_traces.h"

#include <vector>

#include "base/text.h"
#include "datasets/smoothness.h"
#include "fitting/filtered_noise.h"
#include "model/pose_filter.h"

namespace hoplab {
namespace {

bool NeighboursAreAlike(const FitProblem& problem) {
  std::vector<double> smoothness;
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    const Channel channel = problem.channels[c].channel;
    // A pitch may be known so well that its differences are those of the motion.
    if (!IsFiltered(channel) || channel == Channel::kBodyPitch) continue;
    const std::vector<std::vector<double>> samples = SamplesOf(problem, c);
    std::vector<SampledColumn> columns;
    for (std::size_t i = 0; i < samples.size(); ++i)
      columns.push_back({problem.trials[i].row_times, samples[i]});
    smoothness.push_back(SmoothnessOfNoise(columns));
  }
  return AreSmoothed(smoothness);
}

struct Told {
  const char *sees, *effect;
};
Told ToldOf(RecordFilter filter) {
  switch (filter) {
    case RecordFilter::kOnePass:
      return {
          "neighbouring samples have the same noise, as a filter leaves it that runs as the "
          "samples come in, and lags",
          "sensor_causal_low_pass"};
    case RecordFilter::kMovingAverage:
      return {"each sample shares its noise with those beside it, as a moving average leaves it",
              "sensor_moving_average"};
    default:
      return {"neighbouring samples have the same noise, as a filter leaves it", "sensor_low_pass"};
  }
}

std::vector<Channel> ChannelsThrough(const std::vector<RecordFilter>& seen,
                                     const FitProblem& problem) {
  std::vector<Channel> channels;
  if (seen.empty() || !IsSurelyOfFilter(seen.front())) return channels;
  for (const ChannelProblem& channel : problem.channels)
    if (IsFiltered(channel.channel)) channels.push_back(channel.channel);
  return channels;
}

}  // namespace

std::vector<RecordFilter> FiltersSeen(const FitProblem& problem) {
  const NoiseShape noise = NoiseShapeOf(problem);
  if (noise.filter != RecordFilter::kNone) return {noise.filter};
  if (NeighboursAreAlike(problem)) return {RecordFilter::kTwoPass};
  return {};
}

std::vector<Channel> SmoothedChannels(const FitProblem& problem) {
  return ChannelsThrough(FiltersSeen(problem), problem);
}

std::vector<std::string> SmoothedTraces(const FitProblem& problem) {
  const std::vector<RecordFilter> seen = FiltersSeen(problem);
  std::vector<std::string> names;
  for (const Channel c : ChannelsThrough(seen, problem)) names.push_back(ChannelName(c));
  if (names.empty()) return {};
  const Told told = ToldOf(seen.front());
  return {Join(names) + ": " + told.sees +
          ". What it took from the motion, a simulation must lack, too: export the traces as they "
          "were recorded, or fit the filter (--with " +
          told.effect + "; diagnose tries it)"};
}

}  // namespace hoplab
