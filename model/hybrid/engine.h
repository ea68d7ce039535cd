#pragma once

#include <array>
#include <span>
#include <variant>
#include <vector>

#include "model/hybrid/event_location.h"
#include "model/hybrid/hybrid_system.h"
#include "model/hybrid/row_cursor.h"
#include "model/integrators/cvodes.h"
#include "model/integrators/dop853.h"
#include "model/integrators/erkstep.h"
#include "model/trajectory.h"

namespace hoplab {

/// What a run of the automaton does besides running: how long, how many hops.
struct RunSettings {
  double horizon = 1.0;             // s
  int max_hops = 0;                 // 0: no limit
  bool fly_on = false;              // rows past the end are read from a free flight
  std::span<const Foot> feet = {};  // a run that goes on with these
};

/// One mechanism in the scalar types a run needs: T for flow and resets, double and Jet<1> to watch
/// the guards.
template <class T>
struct Automaton {
  HybridSystem<T>& running;
  HybridSystem<double>& values;
  HybridSystem<Jet<1>>& rates;
};

/// Runs a hybrid automaton: modes integrated by a stepper (or in closed form), guards located to
/// solver accuracy, resets with the derivative of the event time (M16) and the saltation (M17).
/// Compiled for the scalar types double, Jet<1>, Jet<kNarrowJet>, Jet<kWideJet> and
/// Jet<kWidestJet>. What the stepper integrates is the flat vector of flat_state.h: dS/dt = f_x S +
/// f_p by duals.
template <class T>
class Engine {
 public:
  /// All that is passed by reference outlives the engine.
  Engine(const Automaton<T>& automaton, const IntegratorOptions& options,
         const RunSettings& settings, RowReader<T>& rows, Trajectory& out);

  /// Runs from `z0` in `mode` at time 0.
  void Run(Mode mode, const T* z0);
  const T* final_state() const { return z_; }
  /// dt_event/dp of every event, row-major [event][direction].
  const std::vector<double>& event_times() const { return event_times_; }

 private:
  static constexpr int kWidth = kJetWidth<T>;

  Outcome Loop();
  GuardCrossing PassKnots();
  std::optional<Outcome> FireAtOnce(const GuardRates& at_start, bool begins, GuardCrossing& fired,
                                    bool& with_last_event);
  bool IsMissedSection() const;
  bool Advance(const GuardRates& at_start, GuardCrossing& crossing);
  std::optional<Outcome> Process(int guard, bool with_last_event);
  bool MovesBody() const { return states_ >= 4; }
  Event EventBefore(const GuardSpec& spec, const T& event_time, double rate) const;
  T EventTimeShift(int guard, double rate, double scale, bool with_last_event);
  bool IsSimultaneous(int guard, const GuardRates& at) const;
  void CountHop(const EventTraits& traits, bool is_hop);
  void FinishSegment();

  GuardCrossing FlyBallistic();
  bool Integrate(GuardRates before, GuardCrossing& crossing);
  double LongestStep() const;
  void TakeStepperState();

  void EmitInsideStep(double until);
  void RowsBeforeStart();

  void Values(double* z) const {
    for (int i = 0; i < states_; ++i) z[i] = Value(z_[i]);
  }
  void Copy(const T* from, T* to) const {
    for (int i = 0; i < states_; ++i) to[i] = from[i];
  }
  static void Derivative(const void* engine, double t, const double* y, double* dy);

  HybridSystem<T>& system_;
  GuardWatch watch_;
  RunSettings settings_;
  RowCursor<T> rows_;
  Trajectory& out_;
  Mode mode_ = Mode::kFlight;
  int states_;
  long max_steps_;
  bool explicit_;             // the solver is
  double units_[kMaxStates];  // of errors
  std::variant<std::monostate, Dop853, ErkStepper, CvodesStepper> solver_;
  Stepper* stepper_;
  T z_[kMaxStates];
  mutable T inside_[kMaxStates], rate_[kMaxStates];  // of Derivative
  double t_ = 0.0, segment_begin_ = 0.0, stance_step_ = 0.0;
  bool entered_ = false;        // the last event led into another mode, or changed the flow
  bool flow_changed_ = false;   // it did the latter
  double section_time_ = -1.0;  // of the last event that was a section
  bool hopped_ = false;
  T event_time_variation_{0.0};  // of the last event; its value is 0
  bool last_began_stance_ = false;
  std::vector<double> event_times_;
};

}  // namespace hoplab
