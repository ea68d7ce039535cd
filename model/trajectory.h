#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "model/hybrid/automaton.h"

namespace hoplab {

/// A located guard crossing.
struct Event {
  EventKind kind = EventKind::kApex;
  Mode mode_before = Mode::kFlight, mode_after = Mode::kFlight;
  double time = 0.0;                            // s since the start
  double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0;  // just before the reset [m], [m/s]
  double vx_after = 0.0, vy_after = 0.0;        // just after it [m/s]
  /// Rate of the guard in units of its scale [1/s]: M16's denominator. Near 0 the event grazes.
  double crossing_rate = 0.0;
  /// Another guard of the mode is at zero at the same instant: derivatives are one-sided.
  bool simultaneous = false;
  int leg = 0;  // of a robot, which leg's or motor's it is; 0 the hindmost
};

/// A stretch of time in one mode.
struct Segment {
  Mode mode = Mode::kFlight;
  double begin = 0.0, end = 0.0;  // s
};

/// What a leg of a robot does on the ground where a run ends, or where it is to go on.
struct Foot {
  enum class Stance { kFlight, kRolling, kToe };
  Stance stance = Stance::kFlight;
  int slides = 0;  // direction in which it slides, 0: it holds

  bool operator==(const Foot&) const = default;
  /// Whether its contact coordinate means a place on the ground.
  bool Holds() const { return stance != Stance::kFlight && slides == 0; }
};

/// A simulated run: outcome, events, segments, and the samples asked for.
/// `samples` is row-major [row][channel]; rows past the end of the run are NaN, or where
/// SimulationRequest::fly_on asks for it those of a free flight from there.
/// `sensitivities` is row-major [row][channel][direction].
/// Everything is in world W, but that the contact coordinate counts along a sloping ground.
/// `final_state` (LegState, of a leg with a toe mass ToeState), its derivatives
/// `final_sensitivities` ([component][direction]) and its rate along the flow `final_rate` belong
/// to the fixed time `end_time`. Of a run that ends at an event, the derivative along that event
/// (on a Poincare section) is S + final_rate dt_event/dp.
struct Trajectory {
  Outcome outcome = Outcome::kCompleted;
  double end_time = 0.0;  // s
  Mode final_mode = Mode::kFlight;
  std::vector<Event> events;
  std::vector<double> event_time_sensitivities;  // row-major [event][direction], M16
  std::vector<Segment> segments;
  std::vector<double> samples;
  std::vector<double> sensitivities;
  std::vector<double> final_state;
  std::vector<double> final_sensitivities;
  std::vector<double> final_rate;
  std::vector<Foot> final_feet;  // of a robot, a leg after the other
  int hops = 0;                  // apexes after a stance (bounces of a ball)
  int rows_in_run = 0;           // the first rows, read before the run ended
  long steps = 0;                // integrator steps taken
  /// Smallest |crossing_rate| over the events that reset something.
  double least_crossing_rate = std::numeric_limits<double>::infinity();
  /// Smallest value, in units of its scale, of a guard that came down and turned back without
  /// crossing: how close the run came to another event sequence.
  double nearest_miss = std::numeric_limits<double>::infinity();
  bool has_simultaneous_events = false;
  /// Largest F C/l0 met (`large_deflection` only): beyond 0.2 its expansion is not to be trusted.
  double max_deflection_ratio = 0.0;

  int directions = 0;
  int channels = 0;
  /// Back to the state of a new one, keeping the memory.
  void Clear() {
    Trajectory fresh;
    const auto keep = [](auto& mine, auto& other) {
      mine.clear();
      other.swap(mine);
    };
    keep(events, fresh.events);
    keep(event_time_sensitivities, fresh.event_time_sensitivities);
    keep(segments, fresh.segments);
    keep(samples, fresh.samples);
    keep(sensitivities, fresh.sensitivities);
    keep(final_state, fresh.final_state);
    keep(final_sensitivities, fresh.final_sensitivities);
    keep(final_rate, fresh.final_rate);
    keep(final_feet, fresh.final_feet);
    *this = std::move(fresh);
  }
};

/// Beyond this F C/l0 the expansion of `large_deflection` is not to be trusted (section 3).
inline constexpr double kMaxDeflectionRatio = 0.2;

}  // namespace hoplab
