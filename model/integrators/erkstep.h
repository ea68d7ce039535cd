#pragma once

#include <memory>

#include "model/integrators/sundials_stepper.h"

namespace hoplab {

/// SUNDIALS ARKODE, explicit (ERKStep), with the Fehlberg pair of order 8 and 7.
class ErkStepSolver {
 public:
  /// The interpolation of ERKStep is of lower order than its steps: rows are stepped to.
  static constexpr bool kReadsInsideStep = false;

  ErkStepSolver(const IntegratorOptions& options, const FlatSystem& system);
  ~ErkStepSolver();
  ErkStepSolver(const ErkStepSolver&) = delete;
  ErkStepSolver& operator=(const ErkStepSolver&) = delete;

  /// Restarts at (t, y).
  void Start(double t, const double* y, double first_step);
  /// One step, or up to t_limit; `t` and `y` become its end.
  StepStatus Step(double t_limit, double* t, double* y);
  /// Integrates from (t0, y0) exactly to `t`; the solver is left there.
  StepStatus EndAt(double t0, const double* y0, double t, double* y);
  /// The state inside the last step, by the solver's own interpolation (low order).
  void At(double t, double* y);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// ErkStepSolver behind the stepper interface.
using ErkStepper = SundialsStepper<ErkStepSolver>;

}  // namespace hoplab
