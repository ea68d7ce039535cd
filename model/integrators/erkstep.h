#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "model/integrators/flat_system.h"
#include "model/integrators/integrator_options.h"

namespace hoplab {

/// SUNDIALS ARKODE, explicit (ERKStep), with the Fehlberg pair of order 8 and 7.
class ErkStepSolver {
 public:
  ErkStepSolver(const IntegratorOptions& options, const FlatSystem& system);
  ~ErkStepSolver();
  ErkStepSolver(const ErkStepSolver&) = delete;
  ErkStepSolver& operator=(const ErkStepSolver&) = delete;

  /// Restarts at (t, y).
  void Start(double t, const double* y, double first_step);
  /// One step, or up to t_limit; `t` and `y` become its end.
  StepStatus Step(double t_limit, double* t, double* y);
  /// Integrates from (t0, y0) exactly to `t`; the solver is left there.
  StepStatus RunTo(double t0, const double* y0, double t, double* y);
  /// The state inside the last step, by the solver's own interpolation (low order).
  void Interpolate(double t, double* y);
  double next_step() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// ErkStepSolver behind the stepper interface of dop853.h.
template <int kSize, int kControlled, class Rhs>
class ErkStepper {
 public:
  /// The interpolation of ERKStep is of lower order than its steps: rows are stepped to.
  static constexpr bool kReadsInsideStep = false;

  ErkStepper(const IntegratorOptions& options, Rhs rhs)
      : rhs_(std::move(rhs)), solver_(options, MakeFlatSystem<kSize, kControlled>(rhs_)) {}

  void Start(double t, const double* y, double first_step) {
    t1_ = t;
    std::copy(y, y + kSize, y1_.begin());
    solver_.Start(t, y, first_step);
    restart_ = false;
  }
  StepStatus Step(double t_limit) {
    t0_ = t1_;
    y0_ = y1_;
    if (restart_) solver_.Start(t0_, y0_.data(), solver_.next_step());
    restart_ = false;
    return solver_.Step(t_limit, &t1_, y1_.data());
  }
  double t0() const { return t0_; }
  double t1() const { return t1_; }
  const double* y0() const { return y0_.data(); }
  const double* y1() const { return y1_.data(); }
  double next_step() const { return solver_.next_step(); }

  void At(double t, double* y) { solver_.Interpolate(t, y); }
  void ValueAt(double t, double* y) {
    std::array<double, kSize> whole;
    solver_.Interpolate(t, whole.data());
    std::copy(whole.begin(), whole.begin() + kControlled, y);
  }
  StepStatus EndAt(double t) {
    t1_ = t;
    restart_ = true;
    return solver_.RunTo(t0_, y0_.data(), t, y1_.data());
  }

 private:
  Rhs rhs_;
  ErkStepSolver solver_;
  double t0_ = 0.0, t1_ = 0.0;
  bool restart_ = false;
  std::array<double, kSize> y0_{}, y1_{};
};

}  // namespace hoplab
