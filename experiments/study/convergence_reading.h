#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "optimize/convergence_time.h"

namespace hoplab {

/// What the study may mean by "the time it takes for the system to reach a horizontal speed within
/// a band around the steady speed" (M48). The first of each is what its tables are read by here: it
/// prints 0.2 s for a fall from 0.3 m, before any apex.
struct ConvergenceReading {
  /// Which speeds are looked at, and when each is told: of a flight at the lift-off that begins it;
  /// at the apex; the mean from apex to apex at its end; every instant.
  enum class Speed { kFlight, kApex, kHopMean, kInstant };
  /// In the band from there on, or in it once.
  enum class Entry { kStays, kFirst };
  /// The band's middle: the last five hops, the last one, or the steady hop itself.
  enum class Steady { kLastFive, kLastHop, kFixedPoint };

  Speed speed = Speed::kFlight;
  Entry entry = Entry::kStays;
  Steady steady = Steady::kLastFive;
  bool operator==(const ConvergenceReading&) const = default;
};

/// All 24, the default first.
std::vector<ConvergenceReading> AllConvergenceReadings();
/// "flight,stays,last_five".
std::string NameOf(const ConvergenceReading& reading);

/// The speeds of a run as the readings look at them, each series in the order of time.
struct SpeedHistory {
  std::vector<ApexSpeed> flight, apex, hop_mean;
  std::vector<ApexSpeed> instant;  // empty unless rows were asked for
};
/// `instants`: samples of vx at `times`, if there are any.
SpeedHistory SpeedHistoryOf(const Trajectory& run, double start_x, std::span<const double> times,
                            std::span<const double> instants);

/// When a run converges by a reading; none where it has fewer than five hops, or where the last of
/// them are not in the band themselves. `fixed_speed`: that of the steady hop, for the readings
/// that ask for it; NaN: unknown, no convergence.
ConvergenceTime ConvergenceTimeOf(const SpeedHistory& history, const ConvergenceReading& reading,
                                  double fixed_speed = std::numeric_limits<double>::quiet_NaN());

}  // namespace hoplab
