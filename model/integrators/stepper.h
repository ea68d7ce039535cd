#pragma once

#include "model/hybrid/automaton.h"
#include "model/integrators/integrator_options.h"
#include "model/jet.h"

namespace hoplab {

/// A right-hand side without its type: dy/dt of a flat vector [state | sensitivities].
struct FlatSystem {
  void (*derivative)(const void* context, double t, const double* y, double* dy);
  const void* context;
  int size;             // of the whole vector, at most kMaxFlatSize
  int controlled;       // leading components that steer the step: the state
  const double* units;  // of each of them: times the absolute tolerance
};
inline constexpr int kMaxFlatSize =
    (kMaxStates * (1 + kWidestJet) + 3) / 4 * 4;  // whole packs of four

/// Steps a flat system. The system outlives the stepper.
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// At() is as accurate as the steps: good enough to read samples from. An event is placed by
  /// EndAt().
  virtual bool reads_inside_step() const = 0;

  /// Begins (again) at `t`; a negative first step integrates backward.
  virtual void Start(double t, const double* y, double first_step) = 0;
  /// One step, never past `t_limit`.
  virtual StepStatus Step(double t_limit) = 0;
  /// The last step's interval and its end.
  double t0() const { return t0_; }
  double t1() const { return t1_; }
  const double* y1() const { return y1_; }
  /// dy/dt at the end of the last step; null where the method does not have it.
  virtual const double* rate1() const { return nullptr; }

  /// The state inside the last step, by the continuous extension.
  virtual void At(double t, double* y) = 0;
  /// The controlled part of it only.
  virtual void ValueAt(double t, double* y) = 0;
  /// Takes the last step again so that it ends exactly at `t`.
  virtual StepStatus EndAt(double t) = 0;

 protected:
  double t0_ = 0.0, t1_ = 0.0;
  alignas(32) double y1_[kMaxFlatSize];
};

}  // namespace hoplab
