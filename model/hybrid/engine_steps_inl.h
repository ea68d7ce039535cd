#pragma once

#include <algorithm>
#include <limits>

#include "model/hybrid/engine.h"
#include "model/hybrid/flat_state.h"

// How a run moves through a mode: flights in closed form, steps of a solver. Of engine.cc alone.

namespace hoplab {

// ---- flight in closed form ---------------------------------------------------------------

template <class T>
GuardCrossing Engine<T>::FlyBallistic() {
  const BallisticFlight<T> flight = system_.Ballistic(z_);
  const GuardCrossing crossing = flight.Next(t_, settings_.horizon, z_);
  rows_.OnFlight(flight, mode_, t_, z_, crossing.time);
  flight.Advance(T(crossing.time - t_), z_);
  t_ = crossing.time;
  return crossing;
}

// ---- modes that need a solver ------------------------------------------------------------

template <class T>
bool Engine<T>::Integrate(GuardRates before, GuardCrossing& crossing) {
  const bool flight = mode_ == Mode::kFlight;
  ArmedGuards armed = watch_.Arm(mode_, before);
  const double knot = system_.NextKnot(mode_), end = std::min(settings_.horizon, knot);
  const double remaining = end - t_;
  if (remaining <= 0.0) return true;
  double y[kMaxFlatSize];
  Pack(z_, states_, y);
  double first = system_.FirstStep(mode_, z_);
  // A leg's stances resemble each other: begin with the step the last one began with.
  if (!flight && stance_step_ > 0.0) first = stance_step_;
  stepper_->Start(t_, y, std::min(first, remaining));
  bool first_step = true;
  const double longest = LongestStep();
  while (true) {
    double limit = std::min(end, stepper_->t1() + longest);
    if (!stepper_->reads_inside_step()) limit = rows_.NextTime(stepper_->t1(), limit);
    if (out_.steps >= max_steps_ || stepper_->Step(limit) == StepStatus::kFailed) {
      TakeStepperState();
      return false;
    }
    ++out_.steps;
    // A step that a knot cuts short says nothing of the next stance's.
    if (first_step && !flight && stepper_->t1() < knot)
      stance_step_ = stepper_->t1() - stepper_->t0();
    first_step = false;
    const GuardRates after =
        watch_.RatesAt(mode_, stepper_->t1(), stepper_->y1(), stepper_->rate1());
    crossing = watch_.FirstCrossing(mode_, *stepper_, before, after, armed, out_.nearest_miss);
    if (crossing.guard >= 0 && !watch_.Polish(mode_, *stepper_, crossing)) {
      TakeStepperState();
      return false;
    }
    EmitInsideStep(crossing.guard >= 0 ? crossing.time : stepper_->t1());
    const bool done = crossing.guard >= 0 || stepper_->t1() >= end;
    if (done) TakeStepperState();
    if (crossing.guard >= 0 || !done)
      out_.max_deflection_ratio =
          std::max(out_.max_deflection_ratio, watch_.DeflectionRatio(mode_, stepper_->y1()));
    if (done) return true;
    before = after;
  }
}

template <class T>
double Engine<T>::LongestStep() const {
  if (explicit_) return system_.LongestStep(mode_, T(t_), z_);
  return std::numeric_limits<double>::infinity();
}

template <class T>
void Engine<T>::TakeStepperState() {
  Unpack(stepper_->y1(), states_, z_);
  t_ = stepper_->t1();
}

template <class T>
void Engine<T>::EmitInsideStep(double until) {
  rows_.Through(mode_, until, [this](double t, T* z) {
    double y[kMaxFlatSize];
    if (t == stepper_->t1()) return Unpack(stepper_->y1(), states_, z);
    stepper_->At(t, y);
    Unpack(y, states_, z);
  });
}

// Rows read before the start (a delay): the body is on the backward continuation of its flight.
template <class T>
void Engine<T>::RowsBeforeStart() {
  const int before = rows_.BeforeStart();
  if (before == 0) return;
  if (system_.IsBallistic(mode_))
    return rows_.OnFlight(system_.Ballistic(z_), mode_, 0.0, z_, Value(rows_.TimeOf(before - 1)));
  double y[kMaxFlatSize];
  T z[kMaxStates];
  Pack(z_, states_, y);
  stepper_->Start(0.0, y, -1e-3);
  for (int row = before - 1; row >= 0; --row) {
    const T time = rows_.TimeOf(row);
    while (stepper_->t1() > Value(time)) {
      if (stepper_->Step(Value(time)) == StepStatus::kFailed) break;
    }
    Unpack(stepper_->y1(), states_, z);
    rows_.Emit(row, mode_, time, z);
  }
  rows_.Reset(before);
}

}  // namespace hoplab
