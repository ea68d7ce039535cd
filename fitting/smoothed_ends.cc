#include "fitting/smoothed_ends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "fitting/flight_tops.h"
#include "model/pose_filter.h"

namespace hoplab {
namespace {

constexpr double kReach = 5.0;        // time constants
constexpr double kMostShare = 0.125;  // of a trial, at either end

std::span<const double> ColumnOf(const Trial& trial, Channel channel) {
  const std::vector<double>* values = trial.trace.Find(channel);
  return values ? std::span<const double>(*values) : std::span<const double>();
}

// Infinite also of a robot, whose legs land one by one.
double FilterTimeOf(const Dataset& dataset) {
  std::vector<PlaceTrace> traces;
  for (const Trial& trial : dataset.trials) {
    if (trial.mechanism.type == MechanismKind::kRobot)
      return std::numeric_limits<double>::infinity();
    traces.push_back({trial.trace.time_s, ColumnOf(trial, Channel::kBodyX),
                      ColumnOf(trial, Channel::kBodyY), FreeFall(trial.mechanism)});
  }
  return FilterTimeOf(traces, FindFlightTops(traces));
}

}  // namespace

std::vector<TraceFault> FindSmoothedEnds(const Dataset& dataset) {
  std::vector<TraceFault> ends;
  const double tau = FilterTimeOf(dataset);
  if (!std::isfinite(tau)) return ends;
  for (const ChannelSpec& channel : dataset.channels) {
    if (!IsFiltered(channel.id)) continue;
    for (std::size_t k = 0; k < dataset.trials.size(); ++k) {
      const Trace& trace = dataset.trials[k].trace;
      const std::vector<double>* values = trace.Find(channel.id);
      if (!values || trace.time_s.empty()) continue;
      const double begin = trace.time_s.front(), end = trace.time_s.back();
      const double reach = std::min(kReach * tau, kMostShare * (end - begin));
      TraceFault first{TraceFault::Kind::kSmoothedEnd, k, channel.id, {}}, last = first;
      for (std::size_t row = 0; row < values->size(); ++row) {
        if (std::isnan((*values)[row])) continue;
        if (trace.time_s[row] < begin + reach) first.rows.push_back(row);
        if (trace.time_s[row] > end - reach) last.rows.push_back(row);
      }
      for (TraceFault* fault : {&first, &last})
        if (!fault->rows.empty()) ends.push_back(*fault);
    }
  }
  return ends;
}

}  // namespace hoplab
