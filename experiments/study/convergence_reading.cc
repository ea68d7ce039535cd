#include "experiments/study/convergence_reading.h"

#include <array>
#include <cmath>

namespace hoplab {
namespace {

constexpr std::size_t kSteadyHops = 5;
using Speed = ConvergenceReading::Speed;
using Entry = ConvergenceReading::Entry;
using Steady = ConvergenceReading::Steady;

const std::vector<ApexSpeed>& SeriesOf(const SpeedHistory& history, Speed speed) {
  switch (speed) {
    case Speed::kFlight:
      return history.flight;
    case Speed::kApex:
      return history.apex;
    case Speed::kHopMean:
      return history.hop_mean;
    case Speed::kInstant:
      break;
  }
  return history.instant;
}

// How many points at the end of `series` belong to the last `hops` hops.
std::size_t PointsOfLastHops(const SpeedHistory& history, const std::vector<ApexSpeed>& series,
                             std::size_t hops) {
  if (&series != &history.instant) return hops;
  const double from = history.apex[history.apex.size() - hops].time;
  std::size_t count = 0;
  while (count < series.size() && series[series.size() - 1 - count].time >= from) ++count;
  return count;
}

double MeanOfLast(const std::vector<ApexSpeed>& series, std::size_t count) {
  double sum = 0.0;
  for (std::size_t i = series.size() - count; i < series.size(); ++i) sum += series[i].vx;
  return sum / static_cast<double>(count);
}

// Index of the point that convergence is told by; the number of points if the last `tail` of them
// are not all in the band.
std::size_t Converged(const std::vector<ApexSpeed>& series, double steady, double band,
                      std::size_t tail, Entry entry) {
  const auto is_in = [&](std::size_t i) {
    return std::abs(series[i].vx - steady) <= band * std::abs(steady);
  };
  std::size_t first = series.size();
  while (first > 0 && is_in(first - 1)) --first;
  if (first + tail > series.size()) return series.size();
  if (entry == Entry::kStays) return first;
  first = 0;
  while (!is_in(first)) ++first;
  return first;
}

}  // namespace

std::vector<ConvergenceReading> AllConvergenceReadings() {
  std::vector<ConvergenceReading> readings;
  for (const Speed speed : {Speed::kFlight, Speed::kApex, Speed::kHopMean, Speed::kInstant}) {
    for (const Entry entry : {Entry::kStays, Entry::kFirst}) {
      for (const Steady steady : {Steady::kLastFive, Steady::kLastHop, Steady::kFixedPoint})
        readings.push_back({speed, entry, steady});
    }
  }
  return readings;
}

std::string NameOf(const ConvergenceReading& reading) {
  static constexpr std::array kSpeeds = {"flight", "apex", "hop_mean", "instant"};
  static constexpr std::array kEntries = {"stays", "first"};
  static constexpr std::array kSteady = {"last_five", "last_hop", "fixed_point"};
  return std::string(kSpeeds[static_cast<std::size_t>(reading.speed)]) + "," +
         kEntries[static_cast<std::size_t>(reading.entry)] + "," +
         kSteady[static_cast<std::size_t>(reading.steady)];
}

SpeedHistory SpeedHistoryOf(const Trajectory& run, double start_x, std::span<const double> times,
                            std::span<const double> instants) {
  SpeedHistory history;
  double liftoff = 0.0, before = 0.0, x_before = start_x;
  for (const Event& event : run.events) {
    if (event.kind == EventKind::kLiftoff) liftoff = event.time;
    if (event.kind != EventKind::kApex) continue;
    history.apex.push_back({event.time, event.vx});
    history.flight.push_back({liftoff, event.vx});
    history.hop_mean.push_back({event.time, (event.x - x_before) / (event.time - before)});
    before = event.time;
    x_before = event.x;
  }
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (std::isfinite(instants[i])) history.instant.push_back({times[i], instants[i]});
  }
  return history;
}

ConvergenceTime ConvergenceTimeOf(const SpeedHistory& history, const ConvergenceReading& reading,
                                  double fixed_speed) {
  ConvergenceTime result;
  const std::vector<ApexSpeed>& series = SeriesOf(history, reading.speed);
  if (history.apex.size() < kSteadyHops || series.empty()) return result;
  const std::size_t tail = PointsOfLastHops(history, series, kSteadyHops);
  if (tail == 0) return result;
  const std::size_t middle = reading.steady == Steady::kLastHop
                                 ? std::max<std::size_t>(1, PointsOfLastHops(history, series, 1))
                                 : tail;
  result.steady_speed =
      reading.steady == Steady::kFixedPoint ? fixed_speed : MeanOfLast(series, middle);
  if (std::isnan(result.steady_speed)) return result;
  result.spread = 0.0;
  for (std::size_t i = series.size() - tail; i < series.size(); ++i)
    result.spread = std::max(result.spread, std::abs(series[i].vx - result.steady_speed));
  result.spread /= std::abs(result.steady_speed);
  for (const auto& [band, name] : {std::pair{0.01, ConvergenceTime::Band::kOnePercent},
                                   std::pair{0.02, ConvergenceTime::Band::kTwoPercent}}) {
    const std::size_t at = Converged(series, result.steady_speed, band, tail, reading.entry);
    if (at == series.size()) continue;
    result.band = name;
    result.time = series[at].time;
    result.hops = static_cast<int>(at) + 1;
    return result;
  }
  return result;
}

}  // namespace hoplab
