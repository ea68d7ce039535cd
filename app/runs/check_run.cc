#include "app/runs/check_run.h"

#include "fitting/filtered_noise.h"

namespace hoplab {
namespace {

std::vector<ChannelNoise> NoiseOf(const Dataset& dataset) {
  const NoiseShape shape = NoiseShapeOf(dataset);
  std::vector<ChannelNoise> noise;
  for (const ChannelSpec& spec : dataset.channels) {
    if (IsContact(spec.id)) continue;
    ChannelNoise entry{ChannelName(spec.id), ChannelUnit(spec.id)};
    if (spec.sigma) entry.stated = *spec.sigma;
    entry.in_traces = NoiseInTraces(dataset, spec.id, shape);
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
