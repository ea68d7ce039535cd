#pragma once

#include <memory>

#include "model/integrators/sundials_stepper.h"

namespace hoplab {

/// SUNDIALS CVODES: backward differentiation formulas for stiff modes, sensitivities by its own
/// forward method (simultaneous corrector).
class CvodesSolver {
 public:
  /// The interpolating polynomial of a multistep method is as accurate as its steps.
  static constexpr bool kReadsInsideStep = true;

  CvodesSolver(const IntegratorOptions& options, const FlatSystem& system);
  ~CvodesSolver();
  CvodesSolver(const CvodesSolver&) = delete;
  CvodesSolver& operator=(const CvodesSolver&) = delete;

  void Start(double t, const double* y, double first_step);
  StepStatus Step(double t_limit, double* t, double* y);
  StepStatus At(double t, double* y);
  StepStatus EndAt(double, const double*, double t, double* y) { return At(t, y); }

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// CvodesSolver behind the stepper interface.
using CvodesStepper = SundialsStepper<CvodesSolver>;

}  // namespace hoplab
