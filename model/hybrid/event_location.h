#pragma once

#include <array>

#include "model/hybrid/hybrid_system.h"
#include "model/integrators/stepper.h"
#include "model/jet.h"

namespace hoplab {

/// Two guards reach zero at the same instant if this close in time [s]: well above the accuracy of
/// an event time, well below anything a trace resolves.
inline constexpr double kSimultaneous = 1e-9;
/// |rate|/scale of a guard [1/s] below which a crossing counts as grazing: M16 would magnify
/// rounding to 1e-5 there.
inline constexpr double kGrazingRate = 1e-6;

/// Values of the guards of a mode in units of their scales, and their rates along the flow [1/s].
struct GuardRates {
  std::array<double, kMaxGuards> value, rate;
};
/// Which guards have been open since their mode began: only those can cross.
using ArmedGuards = std::array<bool, kMaxGuards>;

/// Watches the guards of a hybrid automaton along its flow and finds their zeros. It has the
/// automaton twice: in double for values, in Jet<1> for rates along the flow.
class GuardWatch {
 public:
  GuardWatch(HybridSystem<double>& values, HybridSystem<Jet<1>>& rates)
      : values_(values), rates_(rates) {}

  /// Takes over the discrete state of the automaton that runs.
  template <class T>
  void Follow(const HybridSystem<T>& running) {
    DiscreteState state, again;
    running.SaveDiscreteState(state);
    again = state;
    values_.LoadDiscreteState(state);
    rates_.LoadDiscreteState(again);
  }
  /// dz/dt of the values.
  void Flow(Mode mode, double t, const double* z, double* dz) const {
    values_.Derivative(mode, t, z, dz);
  }
  double DeflectionRatio(Mode mode, const double* z) const {
    return values_.DeflectionRatio(mode, z);
  }

  /// Guards at a state, of which `flow` is dz/dt where that is known.
  GuardRates RatesAt(Mode mode, double t, const double* z, const double* flow = nullptr) const;

  /// Guards that may fire from a state where they stand as `at`: open, or at zero and opening.
  ArmedGuards Arm(Mode mode, const GuardRates& at) const;

  /// First crossing inside the stepper's last step, given the guards at both its ends. Guards that
  /// open in it are armed. `nearest_miss` falls to the lowest value of a guard that turned back.
  GuardCrossing FirstCrossing(Mode mode, Stepper& stepper, const GuardRates& before,
                              const GuardRates& after, ArmedGuards& armed,
                              double& nearest_miss) const;

  /// Ends the stepper's last step on the guard: steps to the crossing and corrects by Newton until
  /// the time moves no more than a first-order correction can mend exactly. False: solver failed.
  bool Polish(Mode mode, Stepper& stepper, GuardCrossing& crossing) const;

 private:
  auto GuardInside(Mode mode, Stepper& stepper, int i) const;
  GuardCrossing Locate(Mode mode, Stepper& stepper, int i, double value_before, double a,
                       double b) const;
  GuardCrossing LookForDip(Mode mode, Stepper& stepper, int i, const GuardRates& before,
                           const GuardRates& after, double& nearest_miss) const;

  HybridSystem<double>& values_;
  HybridSystem<Jet<1>>& rates_;
};

}  // namespace hoplab
