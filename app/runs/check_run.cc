#include "app/runs/check_run.h"

#include "fitting/noise.h"

namespace hoplab {
namespace {

std::vector<ChannelNoise> NoiseOf(const Dataset& dataset) {
  std::vector<ChannelNoise> noise;
  for (const ChannelSpec& spec : dataset.channels) {
    if (IsContact(spec.id)) continue;
    std::vector<SampledColumn> columns;
    for (const Trial& trial : dataset.trials) {
      if (const std::vector<double>* values = trial.trace.Find(spec.id))
        columns.push_back({trial.trace.time_s, *values});
    }
    ChannelNoise entry{ChannelName(spec.id), ChannelUnit(spec.id)};
    if (spec.sigma) entry.stated = *spec.sigma;
    entry.in_traces = EstimateNoise(columns);
    noise.push_back(entry);
  }
  return noise;
}

}  // namespace

CheckRun RunCheck(const Dataset& dataset, const ProblemOptions& options, int jobs) {
  CheckRun run{MakeProblem(dataset, options), {}, {}};
  run.check = CheckDataset(dataset, run.problem, jobs);
  run.noise = NoiseOf(dataset);
  return run;
}

}  // namespace hoplab
