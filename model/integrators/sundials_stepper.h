#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "model/integrators/flat_system.h"
#include "model/integrators/integrator_options.h"

namespace hoplab {

/// A SUNDIALS solver behind the stepper interface of dop853.h. `Solver` has
///   kReadsInsideStep            At() is as accurate as its steps
///   Start(t, y, first_step)     begins (again) at t
///   Step(t_limit, &t, y)        one step, never past t_limit
///   At(t, y)                    the state inside the last step
///   EndAt(t0, y0, t, y)         the state at t to the accuracy of a step that begins at t0; what
///                               comes next is a Start
template <class Solver, int kSize, int kControlled, class Rhs>
class SundialsStepper {
 public:
  static constexpr bool kReadsInsideStep = Solver::kReadsInsideStep;

  SundialsStepper(const IntegratorOptions& options, Rhs rhs)
      : rhs_(std::move(rhs)), solver_(options, MakeFlatSystem<kSize, kControlled>(rhs_)) {}

  void Start(double t, const double* y, double first_step) {
    t1_ = t;
    std::copy(y, y + kSize, y1_.begin());
    solver_.Start(t, y, first_step);
  }
  StepStatus Step(double t_limit) {
    t0_ = t1_;
    y0_ = y1_;
    return solver_.Step(t_limit, &t1_, y1_.data());
  }
  double t0() const { return t0_; }
  double t1() const { return t1_; }
  const double* y1() const { return y1_.data(); }

  void At(double t, double* y) { solver_.At(t, y); }
  /// The controlled part only.
  void ValueAt(double t, double* y) {
    std::array<double, kSize> whole;
    solver_.At(t, whole.data());
    std::copy(whole.begin(), whole.begin() + kControlled, y);
  }
  StepStatus EndAt(double t) {
    t1_ = t;
    return solver_.EndAt(t0_, y0_.data(), t, y1_.data());
  }

 private:
  Rhs rhs_;
  Solver solver_;
  double t0_ = 0.0, t1_ = 0.0;
  std::array<double, kSize> y0_{}, y1_{};
};

}  // namespace hoplab
