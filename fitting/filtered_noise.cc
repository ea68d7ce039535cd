#include "fitting/filtered_noise.h"

#include <cmath>
#include <utility>

#include "base/nan.h"
#include "datasets/mechanism_spec.h"
#include "fitting/flight_tops.h"
#include "fitting/noise.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

NoiseShape ShapeOf(std::vector<PlaceTrace> traces) {
  const FlightTops tops = FindFlightTops(traces);
  return FindNoiseShape(traces, tops);
}

// NaN where the filter's noise does not say it.
double LoggedSigma(const NoiseShape& noise, Channel channel) {
  const bool along = channel == Channel::kBodyX;
  if (!IsSurelyOfFilter(noise.filter) || !(along || channel == Channel::kBodyY)) return kNaN;
  // Of a filter so slow flights are not long enough: what it makes of stances reaches their tops.
  constexpr double kSlowest_s = 0.02;
  if (noise.filter != RecordFilter::kMovingAverage && noise.time > kSlowest_s) return kNaN;
  return noise.sigma[along ? 0 : 1];
}

}  // namespace

NoiseShape NoiseShapeOf(const FitProblem& problem) {
  if (TraitsOf(problem.law).lands_leg_by_leg) return {};
  std::vector<PlaceTrace> traces;
  for (const TrialProblem& trial : problem.trials)
    traces.push_back({trial.row_times, {}, {}, trial.parameters.g});
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    const Channel channel = problem.channels[c].channel;
    if (channel != Channel::kBodyX && channel != Channel::kBodyY) continue;
    std::vector<std::vector<double>> samples = SamplesOf(problem, c);
    for (std::size_t i = 0; i < traces.size(); ++i)
      (channel == Channel::kBodyX ? traces[i].x : traces[i].y) = std::move(samples[i]);
  }
  return ShapeOf(std::move(traces));
}

NoiseShape NoiseShapeOf(const Dataset& dataset) {
  std::vector<PlaceTrace> traces;
  for (const Trial& trial : dataset.trials) {
    if (trial.mechanism.type == MechanismKind::kRobot) return {};
    const auto column = [&](Channel channel) {
      const std::vector<double>* values = trial.trace.Find(channel);
      return values ? *values : std::vector<double>();
    };
    traces.push_back({trial.trace.time_s, column(Channel::kBodyX), column(Channel::kBodyY),
                      FreeFall(trial.mechanism)});
  }
  return ShapeOf(std::move(traces));
}

double NoiseInTraces(const Dataset& dataset, Channel channel, const NoiseShape& noise) {
  const double logged = LoggedSigma(noise, channel);
  if (!std::isnan(logged)) return logged;
  std::vector<SampledColumn> columns;
  for (const Trial& trial : dataset.trials)
    if (const std::vector<double>* values = trial.trace.Find(channel))
      columns.push_back({trial.trace.time_s, *values});
  return EstimateNoise(columns);
}

std::optional<FilteredNoise> FindFilteredNoise(const FitProblem& problem) {
  FilteredNoise noise{NoiseShapeOf(problem), {}};
  if (!IsSurelyOfFilter(noise.shape.filter)) return std::nullopt;
  for (const ChannelProblem& channel : problem.channels)
    noise.sigma.push_back(LoggedSigma(noise.shape, channel.channel));
  return noise;
}

}  // namespace hoplab
