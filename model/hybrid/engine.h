#pragma once

#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <span>

#include "model/hybrid/automaton.h"
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

/// Right-hand side of the state and its sensitivities in one flat vector
/// [z_0 .. z_{n-1} | dz_0/dp_0 .. dz_0/dp_{N-1} | dz_1/dp_0 ..]: dS/dt = f_x S + f_p by duals.
template <class System>
class AugmentedRightHandSide {
 public:
  using T = typename System::Scalar;
  static constexpr int kDim = System::kDim;
  static constexpr int kWidth = kJetWidth<T>;
  static constexpr int kSize = kDim * (1 + kWidth);

  AugmentedRightHandSide(const System* system, const Mode* mode) : system_(system), mode_(mode) {}

  void operator()(double t, const double* y, double* dy) const {
    if constexpr (kWidth == 0) {
      system_->Derivative(*mode_, t, y, dy);
    } else {
      T z[kDim], dz[kDim];
      Unpack(y, z);
      system_->Derivative(*mode_, T(t), z, dz);
      Pack(dz, dy);
    }
  }

  static void Unpack(const double* y, T* z) {
    for (int i = 0; i < kDim; ++i) {
      z[i] = T(y[i]);
      if constexpr (kWidth > 0) {
        for (int k = 0; k < kWidth; ++k) z[i].v[k] = y[kDim + i * kWidth + k];
      }
    }
  }
  static void Pack(const T* z, double* y) {
    for (int i = 0; i < kDim; ++i) {
      y[i] = Value(z[i]);
      if constexpr (kWidth > 0) {
        for (int k = 0; k < kWidth; ++k) y[kDim + i * kWidth + k] = z[i].v[k];
      }
    }
  }

 private:
  const System* system_;
  const Mode* mode_;
};

/// Runs a hybrid automaton: modes integrated by a stepper (or in closed form), guards located to
/// solver accuracy, resets with the derivative of the event time (M16) and the saltation (M17).
///
/// `System<T>` is the automaton in scalar type T. Three copies are kept: in T for the flow and the
/// resets, in double for values, in Jet<1> for rates along the flow.
/// `Sink` receives the rows: sink(row, mode, t, z, system) with z in T.
template <template <class> class System, class T,
          template <int, int, class> class Stepper, class Sink>
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
      : system_(system), value_system_(value_system), rate_system_(rate_system),
        settings_(settings), sink_(sink), out_(out),
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
    RowsBeforeStart(row_time);
    out_.outcome = Loop(row_time);
    FinishSegment();
    out_.end_time = t_;
    out_.final_mode = mode_;
    out_.final_state.resize(kDim);
    for (int i = 0; i < kDim; ++i) out_.final_state[i] = Value(z_[i]);
    out_.final_rate.resize(kDim);
    value_system_.CopyHidden(system_);
    value_system_.Derivative(mode_, t_, out_.final_state.data(), out_.final_rate.data());
  }
  const std::array<T, kDim>& final_state() const { return z_; }

 private:
  static constexpr int kMaxEvents = 20000;
  /// |guard|/scale below which a guard counts as at zero: rounding of a state of size one.
  static constexpr double kAtZero = 1e-11;
  /// Two guards reach zero at the same instant if this close in time [s]: well above the
  /// accuracy of an event time, well below anything a trace resolves.
  static constexpr double kSimultaneous = 1e-9;
  /// |rate|/scale of a guard [1/s] below which a crossing counts as grazing: M16 would magnify
  /// rounding to 1e-5 there.
  static constexpr double kGrazingRate = 1e-6;

  struct GuardRates {
    std::array<double, kMaxGuards> value, rate;
  };
  struct Crossing {
    int guard = -1;
    double time = 0.0;
  };

  // Values of the guards and their rates along the flow of the current mode.
  GuardRates RatesAt(double t, const double* z) {
    std::array<double, kDim> f;
    value_system_.CopyHidden(system_);
    rate_system_.CopyHidden(system_);
    value_system_.Derivative(mode_, t, z, f.data());
    std::array<Jet<1>, kDim> zj;
    for (int i = 0; i < kDim; ++i) {
      zj[i] = Jet<1>(z[i]);
      zj[i].v[0] = f[i];
    }
    Jet<1> tj(t);
    tj.v[0] = 1.0;
    std::array<Jet<1>, kMaxGuards> g;
    rate_system_.Guards(mode_, tj, zj.data(), g.data());
    GuardRates out{};
    const int count = system_.GuardCount(mode_);
    for (int i = 0; i < count; ++i) {
      const double scale = system_.Guard(mode_, i).scale;
      out.value[i] = g[i].a / scale;
      out.rate[i] = g[i].v[0] / scale;
    }
    return out;
  }
  // One guard at a state, in units of its scale.
  double GuardAt(int guard, double t, const double* z) {
    std::array<double, kMaxGuards> g;
    value_system_.Guards(mode_, t, z, g.data());
    return g[guard] / system_.Guard(mode_, guard).scale;
  }

  template <class RowTime>
  Outcome Loop(const RowTime& row_time) {
    segment_begin_ = t_;
    int chained = 0;  // events at one instant, one after the other
    double last_event_time = -1.0;
    for (int count = 0; count < kMaxEvents; ++count) {
      // A guard that is at zero and coming down where its mode begins fires at once.
      std::array<double, kDim> z;
      for (int i = 0; i < kDim; ++i) z[i] = Value(z_[i]);
      const GuardRates at_start = RatesAt(t_, z.data());
      const int guards = system_.GuardCount(mode_);
      if (count == 0 && at_start.value[0] < -kAtZero) {
        const EventKind first = system_.Guard(mode_, 0).event;
        if (first == EventKind::kTouchdown || first == EventKind::kBounce)
          return Outcome::kStartsInGround;
      }
      int immediate = -1;
      for (int i = 0; i < guards; ++i) {
        const bool at_zero = std::abs(at_start.value[i]) <= kAtZero;
        if (system_.Guard(mode_, i).must_open && after_reset_ &&
            (at_start.value[i] < -kAtZero || (at_zero && at_start.rate[i] <= 0.0)) &&
            last_event_ == EventKind::kTouchdown)
          return Outcome::kNoSupport;
        if (at_zero && at_start.rate[i] < 0.0 && immediate < 0 &&
            system_.Guard(mode_, i).event != EventKind::kApex)
          immediate = i;
      }
      Crossing crossing;
      if (immediate >= 0) {
        crossing = {immediate, t_};
        EmitRows(row_time, t_);
      } else if (!Advance(row_time, at_start, crossing)) {
        return Outcome::kIntegrationFailed;
      }
      if (crossing.guard < 0) return Outcome::kCompleted;  // horizon

      chained = crossing.time - last_event_time < kSimultaneous ? chained + 1 : 0;
      last_event_time = crossing.time;
      if (chained > 4) return Outcome::kChattering;
      if (const auto end = Process(crossing.guard)) return *end;
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
  // Applies M16, the reset, M17; records the event.
  std::optional<Outcome> Process(int guard) {
    const GuardSpec spec = system_.Guard(mode_, guard);
    std::array<double, kDim> z, f_before;
    for (int i = 0; i < kDim; ++i) z[i] = Value(z_[i]);
    const GuardRates at = RatesAt(t_, z.data());
    value_system_.Derivative(mode_, t_, z.data(), f_before.data());
    const double rate = at.rate[guard];
    if (!(std::abs(rate) > kGrazingRate)) return Outcome::kGrazing;

    // M16 in duals; the value part is the last correction of the event time, below rounding.
    std::array<T, kMaxGuards> g;
    system_.Guards(mode_, T(t_), z_.data(), g.data());
    T shift = -g[guard] / (rate * spec.scale);
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
    value_system_.CopyHidden(system_);
    rate_system_.CopyHidden(system_);

    // Back from the event time, which moves with the parameters, to the fixed instant t_.
    for (int i = 0; i < kDim; ++i) z[i] = Value(z_[i]);
    std::array<double, kDim> f_after;
    value_system_.Derivative(mode_, t_, z.data(), f_after.data());
    if constexpr (kWidth > 0) {
      const T moving = event_time - t_;  // value 0
      for (int i = 0; i < kDim; ++i) z_[i] -= f_after[i] * moving;
    }
    event.mode_after = mode_;
    if constexpr (kDim >= 4) {
      event.vx_after = z[2];
      event.vy_after = z[3];
    }
    out_.events.push_back(event);
    for (int k = 0; k < kWidth; ++k) event_times_.push_back(Slope(event_time, k));
    after_reset_ = resets;
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

  void BallisticStateAt(const BallisticFlight<T>& flight, const T& dt,
                        std::array<T, kDim>& z) const {
    z = z_;
    z[0] = z_[0] + dt * (z_[2] + 0.5 * flight.ax * dt);
    z[1] = z_[1] + dt * (z_[3] + 0.5 * flight.ay * dt);
    z[2] = z_[2] + flight.ax * dt;
    z[3] = z_[3] + flight.ay * dt;
  }

  template <class RowTime>
  Crossing FlyBallistic(const RowTime& row_time)
    requires(kDim >= 4)
  {
    const BallisticFlight<T> flight = system_.Ballistic(z_.data());
    const double ay = Value(flight.ay), vy = Value(z_[3]);
    const double above = Value(z_[1] - flight.contact_height);
    double to_apex = std::numeric_limits<double>::infinity();
    // Armed like any guard: what rounding leaves of vy at an apex is not another apex.
    if (vy > kAtZero && ay < 0.0) to_apex = -vy / ay;
    double to_contact = std::numeric_limits<double>::infinity();
    const double square = vy * vy - 2.0 * ay * above;
    if (ay == 0.0) {
      if (vy < 0.0) to_contact = -above / vy;
    } else if (square >= 0.0) {
      const double root = std::sqrt(square);
      // The later root, in the form that does not cancel.
      to_contact = vy >= 0.0 ? -(vy + root) / ay : 2.0 * above / (root - vy);
      if (ay > 0.0) to_contact = vy < 0.0 && above > 0.0 ? 2.0 * above / (root - vy)
                                                      : std::numeric_limits<double>::infinity();
    }
    Crossing crossing;
    double dt = settings_.horizon - t_;
    if (to_apex <= to_contact && to_apex < dt) {
      crossing.guard = 1;
      dt = to_apex;
    } else if (to_contact < dt) {
      crossing.guard = 0;
      dt = to_contact;
    }
    crossing.time = t_ + dt;
    std::array<T, kDim> z;
    for (; next_row_ < rows(); ++next_row_) {
      const T time = row_time(next_row_);
      if (Value(time) > t_ + dt) break;
      BallisticStateAt(flight, time - t_, z);
      sink_(next_row_, mode_, time, z.data(), system_);
    }
    BallisticStateAt(flight, T(dt), z);
    z_ = z;
    t_ += dt;
    return crossing;
  }

  // ---- modes that need a solver ----------------------------------------------------------

  template <class RowTime>
  bool Integrate(const RowTime& row_time, GuardRates before, Crossing& crossing) {
    const int guards = system_.GuardCount(mode_);
    const bool flight = mode_ == Mode::kFlight;
    std::array<double, kMaxGuards> armed{};
    for (int i = 0; i < guards; ++i) {
      armed[i] = before.value[i] > kAtZero ||
                 (std::abs(before.value[i]) <= kAtZero && before.rate[i] > 0.0);
    }
    const double remaining = settings_.horizon - t_;
    if (remaining <= 0.0) return true;
    std::array<double, kSize> y;
    Rhs::Pack(z_.data(), y.data());
    double first = system_.FirstStep(mode_, CurrentZ());
    // A leg's stances resemble each other: begin with the step the last one began with.
    if (!flight && stance_step_ > 0.0) first = stance_step_;
    stepper_.Start(t_, y.data(), std::min(first, remaining));
    bool first_step = true;
    while (true) {
      double limit = settings_.horizon;
      if constexpr (!decltype(stepper_)::kReadsInsideStep) limit = NextRowLimit(row_time, limit);
      if (stepper_.Step(limit) == StepStatus::kFailed) {
        TakeStepperState();
        return false;
      }
      ++out_.steps;
      if (first_step && !flight) stance_step_ = stepper_.t1() - stepper_.t0();
      first_step = false;
      const GuardRates after = RatesAt(stepper_.t1(), stepper_.y1());
      crossing = {};
      for (int i = 0; i < guards; ++i) {
        if (!armed[i]) {
          armed[i] = after.value[i] > 0.0;
          continue;
        }
        Crossing found;
        if (after.value[i] < 0.0) {
          found = Locate(i, before.value[i], stepper_.t0(), stepper_.t1());
        } else if (before.rate[i] < 0.0 && after.rate[i] > 0.0) {
          found = LookForDip(i, before, after);
        }
        if (found.guard >= 0 && (crossing.guard < 0 || found.time < crossing.time))
          crossing = found;
      }
      if (crossing.guard >= 0) {
        if (!Polish(crossing)) {
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

  const T* CurrentZ() const { return z_.data(); }
  void TakeStepperState() {
    Rhs::Unpack(stepper_.y1(), z_.data());
    t_ = stepper_.t1();
  }
  void NoteFlexure() {
    out_.max_flexure =
        std::max(out_.max_flexure, value_system_.Flexure(mode_, stepper_.y1()));
  }

  // First zero of guard i in the last step, on the continuous extension.
  Crossing Locate(int i, double value_before, double a, double b) {
    std::array<double, kDim> z;
    const auto g = [&](double t) {
      stepper_.ValueAt(t, z.data());
      return GuardAt(i, t, z.data());
    };
    double ga = value_before, gb = g(b);
    if (!(gb < 0.0)) return {i, b};  // at zero within the extension's error: Polish decides
    if (ga <= kAtZero) {
      // The guard opened at the very start of the step: leave that zero behind.
      double ahead = 1e-3 * (b - a);
      for (; ahead < b - a; ahead *= 2.0) {
        ga = g(a + ahead);
        if (ga > 0.0) break;
      }
      if (!(ga > 0.0)) return {i, a};
      a += ahead;
    }
    std::uintmax_t rounds = 60;
    const auto bracket = boost::math::tools::toms748_solve(
        g, a, b, ga, gb, boost::math::tools::eps_tolerance<double>(34), rounds);
    return {i, 0.5 * (bracket.first + bracket.second)};
  }

  // A guard that came down and turned back inside the step: did it cross in between?
  Crossing LookForDip(int i, const GuardRates& before, const GuardRates& after) {
    const double a = stepper_.t0(), b = stepper_.t1();
    // Both tangents stay above zero where they meet: cannot have crossed unless it wiggles.
    const double meet = (before.value[i] - after.value[i] + after.rate[i] * (b - a)) /
                        (after.rate[i] - before.rate[i]);
    if (before.value[i] + before.rate[i] * meet > 0.5 * std::min(before.value[i], after.value[i]))
      return {};
    std::array<double, kDim> z;
    const auto g = [&](double t) {
      stepper_.ValueAt(t, z.data());
      return GuardAt(i, t, z.data());
    };
    const auto lowest = boost::math::tools::brent_find_minima(g, a, b, 30);
    out_.nearest_miss = std::min(out_.nearest_miss, std::max(lowest.second, 0.0));
    if (lowest.second >= 0.0) return {};
    return Locate(i, before.value[i], a, lowest.first);
  }

  // Ends the step on the guard: steps to the crossing and corrects by Newton until the time moves
  // no more than its first-order correction (done in Process) can mend exactly.
  bool Polish(Crossing& crossing) {
    for (int round = 0; round < 8; ++round) {
      if (crossing.time <= stepper_.t0()) return true;
      if (stepper_.EndAt(crossing.time) == StepStatus::kFailed) return false;
      const GuardRates at = RatesAt(crossing.time, stepper_.y1());
      const double correction = -at.value[crossing.guard] / at.rate[crossing.guard];
      const double step = crossing.time - stepper_.t0();
      if (!std::isfinite(correction) || std::abs(correction) > 0.5 * step) return true;
      if (std::abs(correction) < kSimultaneous) return true;
      crossing.time += correction;
    }
    return true;
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
      if (t == stepper_.t1()) std::copy(stepper_.y1(), stepper_.y1() + kSize, y.begin());
      else stepper_.At(t, y.data());
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
        value_system_.CopyHidden(system_);
        value_system_.Derivative(mode_, Value(time), value.data(), f.data());
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
        const BallisticFlight<T> flight = system_.Ballistic(z_.data());
        std::array<T, kDim> z;
        for (next_row_ = 0; next_row_ < before; ++next_row_) {
          const T time = row_time(next_row_);
          BallisticStateAt(flight, time, z);
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
  System<double> value_system_;
  System<Jet<1>> rate_system_;
  RunSettings settings_;
  Sink& sink_;
  Trajectory& out_;
  Mode mode_ = Mode::kFlight;
  Stepper<kSize, kDim, Rhs> stepper_;
  std::array<T, kDim> z_;
  double t_ = 0.0, segment_begin_ = 0.0, stance_step_ = 0.0;
  int next_row_ = 0;
  bool after_reset_ = false, hopped_ = false;
  EventKind last_event_ = EventKind::kApex;
  std::vector<double> event_times_;
};

}  // namespace hoplab
