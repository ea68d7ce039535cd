#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "model/hybrid/augmented.h"
#include "model/hybrid/automaton.h"
#include "model/hybrid/ballistic.h"
#include "model/hybrid/event_location.h"
#include "model/integrators/integrator_options.h"
#include "model/jet.h"
#include "model/observation.h"
#include "model/trajectory.h"

namespace hoplab {

/// What a run of the automaton does besides running: how long, how many hops, what to sample.
struct RunSettings {
  double horizon = 1.0;  // s
  int max_hops = 0;      // 0: no limit
  /// Row times since the start [s], ascending.
  std::span<const double> row_times;
  std::span<const Channel> channels;
};

/// Runs a hybrid automaton: modes integrated by a stepper (or in closed form), guards located to
/// solver accuracy, resets with the derivative of the event time (M16) and the saltation (M17).
///
/// `System<T>` is the automaton in scalar type T: flow and resets. The same automaton in double and
/// in Jet<1> watches the guards.
/// `Sink` receives the rows: sink(row, mode, t, z, system) with z in T.
template <template <class> class System, class T, template <int, int, class> class Stepper,
          class Sink>
class Engine {
 public:
  using SystemT = System<T>;
  using Rhs = AugmentedRightHandSide<SystemT>;
  static constexpr int kDim = SystemT::kDim;
  static constexpr int kWidth = kJetWidth<T>;
  static constexpr int kSize = Rhs::kSize;

  Engine(const SystemT& system, const System<double>& value_system,
         const System<Jet<1>>& rate_system, const IntegratorOptions& options,
         const RunSettings& settings, Sink& sink, Trajectory& out)
      : system_(system),
        watch_(value_system, rate_system),
        settings_(settings),
        sink_(sink),
        out_(out),
        max_steps_(options.max_steps),
        explicit_(options.kind != IntegratorKind::kCvodes),
        stepper_(options, Rhs(&system_, &mode_)) {}

  /// Runs from `z0` in `mode` at time 0. `row_time(i)` is the time row i was really read at, as T:
  /// an observation effect may shift it.
  template <class RowTime>
  void Run(Mode mode, const T* z0, const RowTime& row_time) {
    mode_ = mode;
    std::copy(z0, z0 + kDim, z_.begin());
    t_ = 0.0;
    next_row_ = 0;
    stance_step_ = 0.0;
    event_times_.reserve(static_cast<std::size_t>(kWidth) * kUsualEvents);
    RowsBeforeStart(row_time);
    out_.outcome = Loop(row_time);
    FinishSegment();
    out_.end_time = t_;
    out_.final_mode = mode_;
    out_.final_state.resize(kDim);
    for (int i = 0; i < kDim; ++i) out_.final_state[i] = Value(z_[i]);
    out_.final_rate.resize(kDim);
    watch_.Follow(system_);
    watch_.Flow(mode_, t_, out_.final_state.data(), out_.final_rate.data());
  }
  const std::array<T, kDim>& final_state() const { return z_; }

 private:
  static constexpr int kMaxEvents = 20000;
  static constexpr int kUsualEvents = 64;
  // Events at one instant, one after the other, beyond which the run is going round in circles.
  static constexpr int kMaxChained = 4;

  template <class RowTime>
  Outcome Loop(const RowTime& row_time) {
    segment_begin_ = t_;
    int chained = 0;  // events at one instant, one after the other
    double last_event_time = -1.0;
    for (int count = 0; count < kMaxEvents; ++count) {
      // A guard that is at zero and coming down where its mode begins fires at once.
      std::array<double, kDim> z;
      for (int i = 0; i < kDim; ++i) z[i] = Value(z_[i]);
      const GuardRates at_start = watch_.RatesAt(mode_, t_, z.data());
      const int guards = system_.GuardCount(mode_);
      if (count == 0 && at_start.value[0] < -kAtZero) {
        const EventKind first = system_.Guard(mode_, 0).event;
        if (first == EventKind::kTouchdown || first == EventKind::kBounce)
          return Outcome::kStartsInGround;
      }
      int immediate = -1;
      bool with_last_event = false;
      for (int i = 0; i < guards && immediate < 0; ++i) {
        const GuardSpec spec = system_.Guard(mode_, i);
        const bool at_zero = std::abs(at_start.value[i]) <= kAtZero;
        const bool closed = at_start.value[i] < -kAtZero || (at_zero && at_start.rate[i] <= 0.0);
        if (spec.if_closed && closed && entered_) {
          if (spec.event != EventKind::kLiftoff || last_event_ == EventKind::kTouchdown)
            return *spec.if_closed;
          immediate = i;
          with_last_event = true;
        } else if (at_zero && at_start.rate[i] < 0.0 && spec.event != EventKind::kApex) {
          immediate = i;
        }
      }
      Crossing crossing;
      if (immediate >= 0) {
        crossing = {immediate, t_};
        EmitRows(row_time, t_);
      } else if (!Advance(row_time, at_start, crossing)) {
        return out_.steps >= max_steps_ ? Outcome::kStepLimit : Outcome::kIntegrationFailed;
      }
      if (crossing.guard < 0) return Outcome::kCompleted;  // horizon

      chained = crossing.time - last_event_time < kSimultaneous ? chained + 1 : 0;
      last_event_time = crossing.time;
      if (chained > kMaxChained) return Outcome::kChattering;
      if (const auto end = Process(crossing.guard, with_last_event)) return *end;
      if (settings_.max_hops > 0 && out_.hops >= settings_.max_hops) return Outcome::kHopLimit;
    }
    return Outcome::kEventLimit;
  }

  // Runs to the next crossing (or the horizon: no guard). False: the solver gave up.
  template <class RowTime>
  bool Advance(const RowTime& row_time, const GuardRates& at_start, Crossing& crossing) {
    if constexpr (kDim >= 4) {
      if (system_.IsBallistic(mode_)) {
        crossing = FlyBallistic(row_time);
        return true;
      }
    }
    return Integrate(row_time, at_start, crossing);
  }

  // The state at a crossing is in z_ at time t_ (both as values with the solver's accuracy).
  // Applies M16, the reset, M17; records the event. `with_last_event`: the guard was closed by the
  // last event, so that this one happens when that one does.
  std::optional<Outcome> Process(int guard, bool with_last_event) {
    const GuardSpec spec = system_.Guard(mode_, guard);
    std::array<double, kDim> z, f_before;
    for (int i = 0; i < kDim; ++i) z[i] = Value(z_[i]);
    const GuardRates at = watch_.RatesAt(mode_, t_, z.data());
    watch_.Flow(mode_, t_, z.data(), f_before.data());
    const double rate = at.rate[guard];
    if (!with_last_event && !(std::abs(rate) > kGrazingRate)) return Outcome::kGrazing;

    // M16 in duals; the value part is the last correction of the event time, below rounding.
    std::array<T, kMaxGuards> g;
    system_.Guards(mode_, T(t_), z_.data(), g.data());
    T shift = with_last_event ? last_moving_ : T(-g[guard] / (rate * spec.scale));
    if (std::abs(Value(shift)) > kSimultaneous) shift = shift - Value(shift);
    const T event_time = t_ + shift;
    for (int i = 0; i < kDim; ++i) z_[i] += f_before[i] * shift;

    Event event;
    event.kind = spec.event;
    event.mode_before = mode_;
    event.time = Value(event_time);
    event.x = Value(z_[0]);
    event.y = Value(z_[1]);
    if constexpr (kDim >= 4) {
      event.vx = Value(z_[2]);
      event.vy = Value(z_[3]);
    }
    event.crossing_rate = rate;
    const int guards = system_.GuardCount(mode_);
    for (int i = 0; i < guards; ++i) {
      if (i == guard || !(std::abs(at.value[i]) <= kSimultaneous * std::abs(at.rate[i]))) continue;
      if (system_.Guard(mode_, i).event == EventKind::kApex) continue;
      event.simultaneous = out_.has_simultaneous_events = true;
    }

    const ResetResult result = system_.Reset(mode_, guard, event_time, z_.data());
    const bool resets = spec.event != EventKind::kApex;
    if (resets) {
      FinishSegment();
      out_.least_crossing_rate = std::min(out_.least_crossing_rate, std::abs(rate));
    }
    mode_ = result.next;
    t_ = Value(event_time);
    segment_begin_ = resets ? t_ : segment_begin_;
    watch_.Follow(system_);

    // Back from the event time, which moves with the parameters, to the fixed instant t_.
    for (int i = 0; i < kDim; ++i) z[i] = Value(z_[i]);
    std::array<double, kDim> f_after;
    watch_.Flow(mode_, t_, z.data(), f_after.data());
    last_moving_ = event_time - t_;  // value 0
    for (int i = 0; i < kDim; ++i) z_[i] -= f_after[i] * last_moving_;
    event.mode_after = mode_;
    if constexpr (kDim >= 4) {
      event.vx_after = z[2];
      event.vy_after = z[3];
    }
    out_.events.push_back(event);
    for (int k = 0; k < kWidth; ++k) event_times_.push_back(Slope(event_time, k));
    entered_ = mode_ != event.mode_before;
    last_event_ = spec.event;
    if (spec.event == EventKind::kLiftoff) hopped_ = true;
    if (spec.event == EventKind::kBounce || (spec.event == EventKind::kApex && hopped_)) {
      ++out_.hops;
      hopped_ = false;
    }
    return result.end;
  }

  void FinishSegment() {
    if (t_ > segment_begin_ || out_.segments.empty())
      out_.segments.push_back({mode_, segment_begin_, t_});
  }

  // ---- flight in closed form -------------------------------------------------------------

  template <class RowTime>
  Crossing FlyBallistic(const RowTime& row_time) requires(kDim >= 4) {
    const auto flight = system_.Ballistic(z_.data());
    const Crossing crossing = flight.Next(t_, settings_.horizon, z_.data());
    for (; next_row_ < rows(); ++next_row_) {
      const T time = row_time(next_row_);
      if (Value(time) > crossing.time) break;
      std::array<T, kDim> z = z_;
      flight.Advance(time - t_, z);
      sink_(next_row_, mode_, time, z.data(), system_);
    }
    flight.Advance(T(crossing.time - t_), z_);
    t_ = crossing.time;
    return crossing;
  }

  // ---- modes that need a solver ----------------------------------------------------------

  template <class RowTime>
  bool Integrate(const RowTime& row_time, GuardRates before, Crossing& crossing) {
    const bool flight = mode_ == Mode::kFlight;
    ArmedGuards armed = watch_.Arm(mode_, before);
    const double remaining = settings_.horizon - t_;
    if (remaining <= 0.0) return true;
    std::array<double, kSize> y;
    Rhs::Pack(z_.data(), y.data());
    double first = system_.FirstStep(mode_, CurrentZ());
    // A leg's stances resemble each other: begin with the step the last one began with.
    if (!flight && stance_step_ > 0.0) first = stance_step_;
    stepper_.Start(t_, y.data(), std::min(first, remaining));
    bool first_step = true;
    const double longest = LongestStep();
    while (true) {
      double limit = std::min(settings_.horizon, stepper_.t1() + longest);
      if constexpr (!decltype(stepper_)::kReadsInsideStep) limit = NextRowLimit(row_time, limit);
      if (out_.steps >= max_steps_ || stepper_.Step(limit) == StepStatus::kFailed) {
        TakeStepperState();
        return false;
      }
      ++out_.steps;
      if (first_step && !flight) stance_step_ = stepper_.t1() - stepper_.t0();
      first_step = false;
      const GuardRates after = watch_.RatesAt(mode_, stepper_.t1(), stepper_.y1());
      crossing = watch_.FirstCrossing(mode_, stepper_, before, after, armed, out_.nearest_miss);
      if (crossing.guard >= 0) {
        if (!watch_.Polish(mode_, stepper_, crossing)) {
          TakeStepperState();
          return false;
        }
        EmitInsideStep(row_time, crossing.time);
        TakeStepperState();
        NoteFlexure();
        return true;
      }
      EmitInsideStep(row_time, stepper_.t1());
      if (stepper_.t1() >= settings_.horizon) {
        TakeStepperState();
        return true;
      }
      before = after;
      NoteFlexure();
    }
  }

  // The step an explicit solver must not exceed where the state alone does not steer it there [s].
  double LongestStep() const {
    if constexpr (requires { system_.LongestStep(mode_, T(t_), CurrentZ()); }) {
      if (explicit_ && kWidth > 0) return system_.LongestStep(mode_, T(t_), CurrentZ());
    }
    return std::numeric_limits<double>::infinity();
  }
  const T* CurrentZ() const { return z_.data(); }
  void TakeStepperState() {
    Rhs::Unpack(stepper_.y1(), z_.data());
    t_ = stepper_.t1();
  }
  void NoteFlexure() {
    out_.max_flexure = std::max(out_.max_flexure, watch_.Flexure(mode_, stepper_.y1()));
  }

  template <class RowTime>
  double NextRowLimit(const RowTime& row_time, double limit) const {
    for (int row = next_row_; row < rows(); ++row) {
      const double time = Value(row_time(row));
      if (time > stepper_.t1()) return std::min(limit, time);
    }
    return limit;
  }

  template <class RowTime>
  void EmitInsideStep(const RowTime& row_time, double until) {
    std::array<double, kSize> y;
    std::array<T, kDim> z;
    for (; next_row_ < rows(); ++next_row_) {
      const T time = row_time(next_row_);
      const double t = Value(time);
      if (t > until) break;
      if (t == stepper_.t1())
        std::copy(stepper_.y1(), stepper_.y1() + kSize, y.begin());
      else
        stepper_.At(t, y.data());
      Rhs::Unpack(y.data(), z.data());
      Emit(time, z);
    }
  }

  // Rows at the instant of an event that fires at once.
  template <class RowTime>
  void EmitRows(const RowTime& row_time, double until) {
    for (; next_row_ < rows(); ++next_row_) {
      const T time = row_time(next_row_);
      if (Value(time) > until) break;
      std::array<T, kDim> z = z_;
      Emit(time, z);
    }
  }

  // One row: the state moved along the flow by the derivative of the row's time.
  void Emit(const T& time, std::array<T, kDim>& z) {
    if constexpr (kWidth > 0) {
      if (!time.v.isZero()) {
        std::array<double, kDim> value, f;
        for (int i = 0; i < kDim; ++i) value[i] = Value(z[i]);
        watch_.Follow(system_);
        watch_.Flow(mode_, Value(time), value.data(), f.data());
        for (int i = 0; i < kDim; ++i) z[i] += f[i] * (time - Value(time));
      }
    }
    sink_(next_row_, mode_, time, z.data(), system_);
  }

  // Rows read before the start (a delay): the body is on the backward continuation of its flight.
  template <class RowTime>
  void RowsBeforeStart(const RowTime& row_time) {
    if (rows() == 0 || Value(row_time(0)) >= 0.0) return;
    int before = 0;
    while (before < rows() && Value(row_time(before)) < 0.0) ++before;
    if constexpr (kDim >= 4) {
      if (system_.IsBallistic(mode_)) {
        const auto flight = system_.Ballistic(z_.data());
        for (next_row_ = 0; next_row_ < before; ++next_row_) {
          const T time = row_time(next_row_);
          std::array<T, kDim> z = z_;
          flight.Advance(time, z);
          sink_(next_row_, mode_, time, z.data(), system_);
        }
        return;
      }
    }
    std::array<double, kSize> y;
    Rhs::Pack(z_.data(), y.data());
    stepper_.Start(0.0, y.data(), -1e-3);
    for (int row = before - 1; row >= 0; --row) {
      const T time = row_time(row);
      while (stepper_.t1() > Value(time)) {
        if (stepper_.Step(Value(time)) == StepStatus::kFailed) break;
      }
      std::array<T, kDim> z;
      Rhs::Unpack(stepper_.y1(), z.data());
      next_row_ = row;
      Emit(time, z);
    }
    next_row_ = before;
  }

  int rows() const { return static_cast<int>(settings_.row_times.size()); }

 public:
  /// dt_event/dp of every event, row-major [event][direction of this chunk].
  const std::vector<double>& event_times() const { return event_times_; }

 private:
  SystemT system_;
  GuardWatch<System> watch_;
  RunSettings settings_;
  Sink& sink_;
  Trajectory& out_;
  Mode mode_ = Mode::kFlight;
  long max_steps_;
  bool explicit_;  // the solver is
  Stepper<kSize, kDim, Rhs> stepper_;
  std::array<T, kDim> z_;
  double t_ = 0.0, segment_begin_ = 0.0, stance_step_ = 0.0;
  int next_row_ = 0;
  bool entered_ = false;  // the last event led into another mode
  bool hopped_ = false;
  T last_moving_{0.0};
  EventKind last_event_ = EventKind::kApex;
  std::vector<double> event_times_;
};

}  // namespace hoplab
