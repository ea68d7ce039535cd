#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "model/integrators/dop853_tables.h"
#include "model/integrators/integrator_options.h"

namespace hoplab {

/// Explicit Runge-Kutta method of order 8 (DOP853) on a vector of kSize doubles of which the first
/// kControlled steer the step (the rest are sensitivities and follow, unless the options say that
/// they steer it as well). No heap, sizes known to the compiler. `Rhs` is called as rhs(t, y, dy).
///
/// Stepper interface, shared with the SUNDIALS steppers:
///   Start(t, y, first_step)  begins (again) at t; a negative first step integrates backward
///   Step(t_limit)            one step, never past t_limit
///   t0(), t1(), y1()         the last step's interval and its end
///   At(t, y)                 the state inside the last step, by the continuous extension
///   EndAt(t)                 takes the last step again so that it ends exactly at t
template <int kSize, int kControlled, class Rhs>
class Dop853 {
 public:
  /// At() is of order 7: good enough to read samples from, not to place an event.
  static constexpr bool kReadsInsideStep = true;

  Dop853(const IntegratorOptions& options, Rhs rhs) : options_(options), rhs_(std::move(rhs)) {}

  void Start(double t, const double* y, double first_step) {
    t1_ = t;
    std::copy(y, y + kSize, y1_.begin());
    rhs_(t, y1_.data(), k_[kNext].data());
    next_step_ = first_step;
    last_error_ = 1e-4;
    rejected_ = false;
  }

  StepStatus Step(double t_limit) {
    t0_ = t1_;
    y0_ = y1_;
    k_[0] = k_[kNext];
    const double to_limit = t_limit - t0_;
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
      double h = next_step_;
      // A step that would leave a sliver takes the sliver along.
      const bool last = std::abs(h) * 1.01 >= std::abs(to_limit);
      if (last) h = to_limit;
      if (std::abs(h) < 1e-14 * (1.0 + std::abs(t0_)) && !last) return StepStatus::kFailed;
      Stages(h);
      const double error = Error(h);
      if (!(error <= 1.0)) {  // also NaN
        const double shrink =
            std::isfinite(error) ? std::max(0.1, 0.9 * std::pow(error, -1.0 / 8.0)) : 0.1;
        next_step_ = h * shrink;
        rejected_ = true;
        continue;
      }
      rhs_(t0_ + h, y1_.data(), k_[kNext].data());
      t1_ = last ? t_limit : t0_ + h;
      h_ = h;
      dense_ready_ = false;
      // PI controller of Hairer and Wanner (beta = 0.02), and no growth right after a rejection.
      const double bounded = std::max(error, 1e-10);
      double grow = 0.9 * std::pow(bounded, -(1.0 / 8.0 - 0.02 * 0.2)) *
                    std::pow(std::max(last_error_, 1e-10), 0.02);
      grow = std::clamp(grow, 0.2, rejected_ ? 1.0 : 6.0);
      last_error_ = std::max(error, 1e-4);
      rejected_ = false;
      // A step cut short by the limit says little about the step to take next.
      const double proposal = h * grow;
      next_step_ =
          last ? std::copysign(std::max(std::abs(proposal), std::abs(next_step_)), h) : proposal;
      return StepStatus::kOk;
    }
    return StepStatus::kFailed;
  }

  double t0() const { return t0_; }
  double t1() const { return t1_; }
  const double* y1() const { return y1_.data(); }

  void At(double t, double* y) { Read<kSize>(t, y); }
  /// The controlled part only.
  void ValueAt(double t, double* y) { Read<kControlled>(t, y); }

  StepStatus EndAt(double t) {
    h_ = t - t0_;
    t1_ = t;
    Stages(h_);
    dense_ready_ = false;
    rhs_(t1_, y1_.data(), k_[kNext].data());
    return std::isfinite(y1_[0]) ? StepStatus::kOk : StepStatus::kFailed;
  }

 private:
  static constexpr int kMaxAttempts = 60;
  static constexpr int kNext = dop853::kStages;  // derivative at the end of the step
  using Vector = std::array<double, kSize>;

  // y = y0 + h sum_j weight_j k_j over the stages with a nonzero weight, unrolled.
  template <int kRow, std::size_t... kJ>
  void Combine(double h, double* y, std::index_sequence<kJ...>) const {
    for (int i = 0; i < kSize; ++i) {
      double sum = 0.0;
      ((dop853::kA[kRow][kJ] != 0.0 ? void(sum += dop853::kA[kRow][kJ] * k_[kJ][i]) : void()), ...);
      y[i] = y0_[i] + h * sum;
    }
  }
  template <int kStage>
  void Stage(double h) {
    Vector y;
    Combine<kStage>(h, y.data(), std::make_index_sequence<kStage>{});
    rhs_(t0_ + dop853::kC[kStage] * h, y.data(), k_[kStage].data());
  }
  template <std::size_t... kI>
  void StageRange(double h, std::index_sequence<kI...>) {
    (Stage<static_cast<int>(kI) + 1>(h), ...);
  }
  void Stages(double h) {
    StageRange(h, std::make_index_sequence<dop853::kStages - 1>{});
    Combine<dop853::kStages>(h, y1_.data(), std::make_index_sequence<dop853::kStages>{});
  }

  double Error(double h) const {
    const double error = ErrorOf(h, 0, kControlled, 1, [this](int i) {
      return options_.absolute_tolerance +
             options_.relative_tolerance * std::max(std::abs(y0_[i]), std::abs(y1_[i]));
    });
    if constexpr (kSize > kControlled) {
      if (options_.steering != 0) return std::fmax(error, SensitivityError(h));
    }
    return error;
  }
  // The same of the steering directions' sensitivities, each relative to the largest of its
  // direction. Infinite where they have left what numbers hold.
  double SensitivityError(double h) const requires(kSize > kControlled) {
    constexpr int kWidth = (kSize - kControlled) / kControlled;
    const double tolerance = options_.absolute_tolerance + options_.relative_tolerance;
    double worst = 0.0;
    for (int k = 0; k < kWidth; ++k) {
      if ((options_.steering >> k & 1u) == 0) continue;
      double scale = 1e-30;
      for (int i = kControlled + k; i < kSize; i += kWidth)
        scale = std::max({scale, std::abs(y0_[i]), std::abs(y1_[i])});
      const double error =
          ErrorOf(h, kControlled + k, kSize, kWidth, [&](int) { return tolerance * scale; });
      if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, error);
    }
    return worst;
  }
  // Hairer's combination of the embedded errors of order 5 and 3 of every `stride`-th component, in
  // units of `scale_of(i)`.
  template <class Scale>
  double ErrorOf(double h, int begin, int end, int stride, const Scale& scale_of) const {
    double error5 = 0.0, error3 = 0.0;
    int count = 0;
    for (int i = begin; i < end; i += stride, ++count) {
      double e5 = 0.0, e3 = 0.0;
      for (int s = 0; s < dop853::kStages; ++s) {
        e5 += dop853::kE5[s] * k_[s][i];
        e3 += dop853::kE3[s] * k_[s][i];
      }
      const double scale = scale_of(i);
      error5 += e5 / scale * (e5 / scale);
      error3 += e3 / scale * (e3 / scale);
    }
    if (error5 == 0.0 && error3 == 0.0) return 0.0;
    const double norm = error5 + 0.01 * error3;
    return std::abs(h) * error5 / std::sqrt(norm * count);
  }

  void PrepareDense() {
    if (dense_ready_) return;
    Stage<13>(h_);
    Stage<14>(h_);
    Stage<15>(h_);
    for (int i = 0; i < kSize; ++i) {
      const double delta = y1_[i] - y0_[i];
      dense_[0][i] = delta;
      dense_[1][i] = h_ * k_[0][i] - delta;
      dense_[2][i] = 2.0 * delta - h_ * (k_[kNext][i] + k_[0][i]);
      for (int d = 0; d < 4; ++d) {
        double sum = 0.0;
        for (int s = 0; s < dop853::kStagesExtended; ++s) sum += dop853::kD[d][s] * k_[s][i];
        dense_[3 + d][i] = h_ * sum;
      }
    }
    dense_ready_ = true;
  }
  template <int kCount>
  void Read(double t, double* y) {
    PrepareDense();
    const double x = (t - t0_) / h_;
    for (int i = 0; i < kCount; ++i) {
      double sum = 0.0;
      for (int j = dop853::kDensePower - 1; j >= 0; --j) {
        sum = (sum + dense_[j][i]) * ((dop853::kDensePower - 1 - j) % 2 == 0 ? x : 1.0 - x);
      }
      y[i] = y0_[i] + sum;
    }
  }

  IntegratorOptions options_;
  Rhs rhs_;
  double t0_ = 0.0, t1_ = 0.0, h_ = 0.0, next_step_ = 0.0, last_error_ = 1e-4;
  bool rejected_ = false, dense_ready_ = false;
  Vector y0_, y1_;
  std::array<Vector, dop853::kStagesExtended> k_;
  std::array<Vector, dop853::kDensePower> dense_;
};

}  // namespace hoplab
