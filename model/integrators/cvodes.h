#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "model/integrators/flat_system.h"
#include "model/integrators/integrator_options.h"

namespace hoplab {

/// SUNDIALS CVODES: backward differentiation formulas for stiff modes, sensitivities by its own
/// forward method (simultaneous corrector).
class CvodesSolver {
 public:
  CvodesSolver(const IntegratorOptions& options, const FlatSystem& system);
  ~CvodesSolver();
  CvodesSolver(const CvodesSolver&) = delete;
  CvodesSolver& operator=(const CvodesSolver&) = delete;

  void Start(double t, const double* y, double first_step);
  StepStatus Step(double t_limit, double* t, double* y);
  /// The state inside the last step: the interpolating polynomial of a multistep method is as
  /// accurate as its steps.
  StepStatus At(double t, double* y);
  double next_step() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// CvodesSolver behind the stepper interface of dop853.h.
template <int kSize, int kControlled, class Rhs>
class CvodesStepper {
 public:
  static constexpr bool kReadsInsideStep = true;

  CvodesStepper(const IntegratorOptions& options, Rhs rhs)
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
  const double* y0() const { return y0_.data(); }
  const double* y1() const { return y1_.data(); }
  double next_step() const { return solver_.next_step(); }

  void At(double t, double* y) { solver_.At(t, y); }
  void ValueAt(double t, double* y) {
    std::array<double, kSize> whole;
    solver_.At(t, whole.data());
    std::copy(whole.begin(), whole.begin() + kControlled, y);
  }
  StepStatus EndAt(double t) {
    t1_ = t;
    return solver_.At(t, y1_.data());
  }

 private:
  Rhs rhs_;
  CvodesSolver solver_;
  double t0_ = 0.0, t1_ = 0.0;
  std::array<double, kSize> y0_{}, y1_{};
};

}  // namespace hoplab
