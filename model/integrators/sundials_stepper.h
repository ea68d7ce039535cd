#pragma once

#include <algorithm>

#include "model/integrators/stepper.h"

namespace hoplab {

/// A SUNDIALS solver behind the stepper interface. `Solver` has
///   kReadsInsideStep            At() is as accurate as its steps
///   Start(t, y, first_step)     begins (again) at t
///   Step(t_limit, &t, y)        one step, never past t_limit
///   At(t, y)                    the state inside the last step
///   EndAt(t0, y0, t, y)         the state at t to the accuracy of a step that begins at t0; what
///                               comes next is a Start
template <class Solver>
class SundialsStepper final : public Stepper {
 public:
  SundialsStepper(const IntegratorOptions& options, const FlatSystem& system)
      : size_(system.size), controlled_(system.controlled), solver_(options, system) {}

  bool reads_inside_step() const override { return Solver::kReadsInsideStep; }
  void Start(double t, const double* y, double first_step) override {
    t1_ = t;
    std::copy_n(y, size_, y1_);
    solver_.Start(t, y, first_step);
  }
  StepStatus Step(double t_limit) override {
    t0_ = t1_;
    std::copy_n(y1_, size_, y0_);
    return solver_.Step(t_limit, &t1_, y1_);
  }
  void At(double t, double* y) override { solver_.At(t, y); }
  void ValueAt(double t, double* y) override {
    double whole[kMaxFlatSize];
    solver_.At(t, whole);
    std::copy_n(whole, controlled_, y);
  }
  StepStatus EndAt(double t) override {
    t1_ = t;
    return solver_.EndAt(t0_, y0_, t, y1_);
  }

 private:
  int size_, controlled_;
  Solver solver_;
  double y0_[kMaxFlatSize];
};

}  // namespace hoplab
