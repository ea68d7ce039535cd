#pragma once

#include "model/integrators/dop853_tables.h"
#include "model/integrators/stepper.h"

namespace hoplab {

/// Explicit Runge-Kutta method of order 8 (DOP853). The state steers the step; sensitivities follow
/// unless the options say that they steer it as well. Its continuous extension is of order 7. No
/// heap.
class Dop853 final : public Stepper {
 public:
  Dop853(const IntegratorOptions& options, const FlatSystem& system);

  bool reads_inside_step() const override { return true; }
  void Start(double t, const double* y, double first_step) override;
  StepStatus Step(double t_limit) override;
  const double* rate1() const override { return k_[kNext]; }
  void At(double t, double* y) override { Read(t, system_.size, y); }
  void ValueAt(double t, double* y) override { Read(t, system_.controlled, y); }
  StepStatus EndAt(double t) override;

 private:
  static constexpr int kNext = dop853::kStages;  // derivative at the end of the step
  using Vector = double[kMaxFlatSize];

  template <int kRow>
  void Combine(double h, double* y) const;
  template <int kStage>
  void Stage(double h);
  void Stages(double h);
  double Error(double h) const;
  double SensitivityError(double h) const;
  template <class Scale>
  double ErrorOf(double h, int begin, int end, int stride, const Scale& scale_of) const;
  void PrepareDense(int count);
  void Read(double t, int count, double* y);
  void Evaluate(double t, const double* y, double* dy) const {
    system_.derivative(system_.context, t, y, dy);
  }

  IntegratorOptions options_;
  FlatSystem system_;
  int padded_;  // size rounded up to whole packs
  double h_ = 0.0, next_step_ = 0.0, last_error_ = 1e-4;
  bool rejected_ = false;
  int dense_ready_ = 0;  // how many components of it are
  alignas(32) Vector y0_;
  alignas(32) Vector k_[dop853::kStagesExtended];
  alignas(32) Vector dense_[dop853::kDensePower];
};

}  // namespace hoplab
