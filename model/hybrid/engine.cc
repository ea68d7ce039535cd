#include "model/hybrid/engine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "model/effects/effect.h"
#include "model/hybrid/engine_steps_inl.h"
#include "model/hybrid/flat_state.h"
#include "model/inputs.h"

namespace hoplab {
namespace {
constexpr int kMaxEvents = 20000;
constexpr int kUsualEvents = 64;
// Events at one instant, one after the other, beyond which the run is going round in circles.
constexpr int kMaxChained = 4;
// Knots closer than this are one instant [s].
constexpr double kSameInstant = InputSignal<double>::kSameInstant;
}  // namespace

template <class T>
Engine<T>::Engine(const Automaton<T>& automaton, const IntegratorOptions& options,
                  const RunSettings& settings, RowReader<T>& rows, Trajectory& out)
    : system_(automaton.running),
      watch_(automaton.values, automaton.rates),
      settings_(settings),
      rows_(rows, system_, watch_),
      out_(out),
      states_(automaton.running.size()),
      max_steps_(options.max_steps),
      explicit_(options.kind != IntegratorKind::kCvodes) {
  HOPLAB_CHECK(states_ <= kMaxStates);
  for (int i = 0; i < states_; ++i) units_[i] = system_.ErrorUnit(i);
  const FlatSystem flat{&Derivative, this, states_ * (1 + kWidth), states_, units_};
  switch (options.kind) {
    case IntegratorKind::kDop853:
      stepper_ = &solver_.template emplace<Dop853>(options, flat);
      break;
    case IntegratorKind::kErkStep:
      stepper_ = &solver_.template emplace<ErkStepper>(options, flat);
      break;
    case IntegratorKind::kCvodes:
      stepper_ = &solver_.template emplace<CvodesStepper>(options, flat);
      break;
  }
}

template <class T>
void Engine<T>::Derivative(const void* engine, double t, const double* y, double* dy) {
  const Engine& self = *static_cast<const Engine*>(engine);
  if constexpr (kWidth == 0) {
    self.system_.Derivative(self.mode_, t, y, dy);
  } else {
    Unpack(y, self.states_, self.inside_);
    self.system_.Derivative(self.mode_, T(t), self.inside_, self.rate_);
    Pack(self.rate_, self.states_, dy);
  }
}

template <class T>
void Engine<T>::Run(Mode mode, const T* z0) {
  Copy(z0, z_);
  mode_ = settings_.feet.empty() ? system_.Begin(mode, z_) : system_.Resume(settings_.feet, z_);
  watch_.Follow(system_);
  t_ = 0.0;
  rows_.Reset(0);
  stance_step_ = 0.0;
  event_times_.reserve(static_cast<std::size_t>(kWidth) * kUsualEvents);
  RowsBeforeStart();
  out_.outcome = Loop();
  FinishSegment();
  out_.rows_in_run = rows_.passed();
  if (settings_.fly_on && out_.outcome != Outcome::kCompleted) {
    // Rows past the end of the run, from the body that flies on from there without a leg.
    if (const auto flight = system_.FreeFlight())
      rows_.OnFlight(*flight, Mode::kFlight, t_, z_, std::numeric_limits<double>::infinity());
  }
  out_.end_time = t_;
  out_.final_mode = mode_;
  out_.final_state.resize(states_);
  Values(out_.final_state.data());
  out_.final_rate.resize(states_);
  watch_.Follow(system_);
  watch_.Flow(mode_, t_, out_.final_state.data(), out_.final_rate.data());
  system_.TellFeet(out_.final_feet);
}

template <class T>
Outcome Engine<T>::Loop() {
  segment_begin_ = t_;
  int chained = 0;  // events at one instant, one after the other
  double last_event_time = -1.0;
  bool begins = true;
  for (int count = 0; count < kMaxEvents;) {
    double z[kMaxStates];
    Values(z);
    const GuardRates at_start = watch_.RatesAt(mode_, t_, z);
    GuardCrossing crossing;
    bool with_last_event = false;
    if (const auto end = FireAtOnce(at_start, begins, crossing, with_last_event)) return *end;
    begins = false;
    if (crossing.guard >= 0) {
      rows_.Through(mode_, t_, [this](double, T* at) { Copy(z_, at); });
    } else if (!Advance(at_start, crossing)) {
      return out_.steps >= max_steps_ ? Outcome::kStepLimit : Outcome::kIntegrationFailed;
    }
    if (crossing.guard < 0) {
      if (t_ >= settings_.horizon) return Outcome::kCompleted;
      crossing = PassKnots();
      if (crossing.guard < 0) continue;
      with_last_event = true;
    }
    ++count;

    chained = crossing.time - last_event_time < kSimultaneous ? chained + 1 : 0;
    last_event_time = crossing.time;
    if (chained > kMaxChained) return Outcome::kChattering;
    if (const auto end = Process(crossing.guard, with_last_event)) return *end;
    if (settings_.max_hops > 0 && out_.hops >= settings_.max_hops) return Outcome::kHopLimit;
  }
  return Outcome::kEventLimit;
}

// Passes what is due at t_ of what drives the mechanism: the flow before and after it meets at the
// knot's own instant, which may move with the parameters (M17 of a reset that changes nothing). A
// guard that a jump closes fires there.
template <class T>
GuardCrossing Engine<T>::PassKnots() {
  double z[kMaxStates], flow[kMaxStates];
  Values(z);
  const GuardRates before = watch_.RatesAt(mode_, t_, z);
  while (system_.NextKnot(mode_) <= t_ + kSameInstant) {
    Values(z);
    watch_.Flow(mode_, t_, z, flow);
    T moved[kMaxStates];
    Copy(z_, moved);
    const std::optional<T> instant = system_.PassKnot(mode_, t_, moved);
    if (!instant) break;
    const T variation = *instant - Value(*instant);
    for (int i = 0; i < states_; ++i) z_[i] = moved[i] + flow[i] * variation;
    watch_.Follow(system_);
    Values(z);
    watch_.Flow(mode_, t_, z, flow);
    for (int i = 0; i < states_; ++i) z_[i] -= flow[i] * variation;
    event_time_variation_ = variation;
  }
  Values(z);
  const GuardRates after = watch_.RatesAt(mode_, t_, z);
  const int guards = system_.GuardCount(mode_);
  for (int i = 0; i < guards; ++i)
    if (before.value[i] > kAtZero && after.value[i] < -kAtZero) return {i, t_};
  return {-1, t_};
}

// A guard that is at zero and coming down where its mode begins fires at once. An outcome where the
// run ends instead. `begins`: the run does. A leg that would pull where it begins in stance lifts
// off.
template <class T>
std::optional<Outcome> Engine<T>::FireAtOnce(const GuardRates& at_start, bool begins,
                                             GuardCrossing& fired, bool& with_last_event) {
  const int guards = system_.GuardCount(mode_);
  for (int i = 0; i < guards; ++i) {
    const GuardSpec spec = system_.Guard(mode_, i);
    const EventTraits& traits = TraitsOf(spec.event);
    if (begins && at_start.value[i] < -kAtZero && traits.meets_ground)
      return Outcome::kStartsInGround;
    bool at_zero = std::abs(at_start.value[i]) <= kAtZero;
    const bool closed = at_start.value[i] < -kAtZero || (at_zero && at_start.rate[i] <= 0.0);
    // Another leg's that came down with the last event, and was found a little before it, is not
    // lost.
    if (!out_.events.empty() && out_.events.back().leg != spec.leg &&
        t_ - out_.events.back().time < kSimultaneous && at_start.value[i] < 0.0)
      at_zero = at_zero || at_start.value[i] > kSimultaneous * at_start.rate[i];
    if (spec.if_closed && closed && (entered_ || begins)) {
      if (!traits.ends_stance || last_began_stance_) return *spec.if_closed;
      with_last_event = true;
    } else if (!(at_zero && at_start.rate[i] < (traits.waits_to_open ? -kGrazingRate : 0.0) &&
                 (!traits.is_section || IsMissedSection()))) {
      continue;
    }
    fired = {i, t_};
    return std::nullopt;
  }
  return std::nullopt;
}

// A section at the very place where the flow changed has not been passed before it.
template <class T>
bool Engine<T>::IsMissedSection() const {
  return flow_changed_ && !(t_ - section_time_ < kSimultaneous);
}

// Runs to the next crossing (or the horizon: no guard). False: the solver gave up.
template <class T>
bool Engine<T>::Advance(const GuardRates& at_start, GuardCrossing& crossing) {
  if (!system_.IsBallistic(mode_)) return Integrate(at_start, crossing);
  crossing = FlyBallistic();
  return true;
}

// M16 in duals; the value part is the last correction of the event time, below rounding.
// `with_last_event`: the guard was closed by the last event, so that this one happens when that one
// does.
template <class T>
T Engine<T>::EventTimeShift(int guard, double rate, double scale, bool with_last_event) {
  if (with_last_event) return event_time_variation_;
  T g[kMaxGuards];
  system_.Guards(mode_, T(t_), z_, g);
  T shift = -g[guard] / (rate * scale);
  // Not before the last event.
  const double last = out_.events.empty() ? 0.0 : out_.events.back().time;
  if (std::abs(Value(shift)) > kSimultaneous || t_ + Value(shift) < last)
    shift = shift - Value(shift);
  return shift;
}

// An event with the state before its reset, which is in z_.
template <class T>
Event Engine<T>::EventBefore(const GuardSpec& spec, const T& event_time, double rate) const {
  Event event;
  event.kind = spec.event;
  event.mode_before = mode_;
  event.time = Value(event_time);
  event.x = Value(z_[0]);
  event.y = Value(z_[1]);
  if (MovesBody()) {
    event.vx = Value(z_[2]);
    event.vy = Value(z_[3]);
  }
  event.crossing_rate = rate;
  event.leg = spec.leg;
  return event;
}

// The state at a crossing is in z_ at time t_ (both as values with the solver's accuracy).
// Applies M16, the reset, M17; records the event.
template <class T>
std::optional<Outcome> Engine<T>::Process(int guard, bool with_last_event) {
  const GuardSpec spec = system_.Guard(mode_, guard);
  const EventTraits& traits = TraitsOf(spec.event);
  double z[kMaxStates], flow[kMaxStates];
  Values(z);
  watch_.Flow(mode_, t_, z, flow);
  const GuardRates at = watch_.RatesAt(mode_, t_, z, flow);
  const double rate = at.rate[guard];
  if (!with_last_event && !(std::abs(rate) > kGrazingRate)) {
    if (!spec.is_smooth) return Outcome::kGrazing;
    system_.Touch(mode_, guard);
    watch_.Follow(system_);
    entered_ = false;
    return std::nullopt;
  }
  const T shift = EventTimeShift(guard, rate, spec.scale, with_last_event);
  const T event_time = t_ + shift;
  for (int i = 0; i < states_; ++i) z_[i] += flow[i] * shift;

  Event event = EventBefore(spec, event_time, rate);
  if (IsSimultaneous(guard, at)) event.simultaneous = out_.has_simultaneous_events = true;

  const ResetResult result = system_.Reset(mode_, guard, event_time, z_);
  if (!traits.is_section) {
    FinishSegment();
    if (!spec.is_smooth)
      out_.least_crossing_rate = std::min(out_.least_crossing_rate, std::abs(rate));
  }
  mode_ = result.next;
  t_ = Value(event_time);
  if (!traits.is_section) segment_begin_ = t_;
  watch_.Follow(system_);

  // Back from the event time, which moves with the parameters, to the fixed instant t_.
  Values(z);
  watch_.Flow(mode_, t_, z, flow);
  event_time_variation_ = event_time - t_;
  for (int i = 0; i < states_; ++i) z_[i] -= flow[i] * event_time_variation_;
  event.mode_after = mode_;
  event.kind = result.turned_out.value_or(event.kind);
  if (MovesBody()) {
    event.vx_after = z[2];
    event.vy_after = z[3];
  }
  out_.events.push_back(event);
  for (int k = 0; k < kWidth; ++k) event_times_.push_back(Slope(event_time, k));
  flow_changed_ = traits.changes_flow;
  entered_ = flow_changed_ || mode_ != event.mode_before;
  if (traits.is_section) section_time_ = t_;
  last_began_stance_ = traits.begins_stance;
  CountHop(traits, result.is_hop);
  return result.end;
}

template <class T>
bool Engine<T>::IsSimultaneous(int guard, const GuardRates& at) const {
  const int guards = system_.GuardCount(mode_);
  const bool section = TraitsOf(system_.Guard(mode_, guard).event).is_section;
  for (int i = 0; i < guards; ++i) {
    if (i == guard || !(std::abs(at.value[i]) <= kSimultaneous * std::abs(at.rate[i]))) continue;
    const EventTraits& other = TraitsOf(system_.Guard(mode_, i).event);
    // A section changes nothing, whatever flow it lies on.
    if (section && other.changes_flow) continue;
    if (!other.is_section && !system_.Guard(mode_, i).is_smooth) return true;
  }
  return false;
}

template <class T>
void Engine<T>::CountHop(const EventTraits& traits, bool is_hop) {
  if (traits.begins_hop) hopped_ = true;
  if (traits.is_hop || (traits.ends_hop && hopped_ && is_hop)) {
    ++out_.hops;
    hopped_ = false;
  }
}

template <class T>
void Engine<T>::FinishSegment() {
  if (t_ > segment_begin_ || out_.segments.empty())
    out_.segments.push_back({mode_, segment_begin_, t_});
}

template class Engine<double>;
template class Engine<Jet<1>>;
template class Engine<Jet<kNarrowJet>>;
template class Engine<Jet<kWideJet>>;
template class Engine<Jet<kWidestJet>>;

}  // namespace hoplab
