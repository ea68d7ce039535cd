#pragma once

#include "model/hybrid/hybrid_system.h"

namespace hoplab::testing {

/// The two-mode linear system of Hiskens and Pai (Trajectory sensitivity analysis of hybrid
/// systems, IEEE Trans. Circuits Syst. I 47, 2000): x' = A1 x until x2 = slope_a x1, then
/// x' = A2 x until x2 = slope_b x1. Mode::kRolling stands for mode 1, Mode::kToe for mode 2.
template <class T>
struct PiecewiseLinear final : HybridSystem<T> {
  T slope_a{2.75}, slope_b{0.36};

  int size() const override { return 2; }
  void Derivative(Mode mode, const T&, const T* x, T* dx) const override {
    if (mode == Mode::kRolling) {
      dx[0] = x[0] - 100.0 * x[1];
      dx[1] = 10.0 * x[0] + x[1];
    } else {
      dx[0] = x[0] + 10.0 * x[1];
      dx[1] = -100.0 * x[0] + x[1];
    }
  }
  int GuardCount(Mode) const override { return 1; }
  GuardSpec Guard(Mode, int) const override { return {EventKind::kSwitch, 1.0}; }
  void Guards(Mode mode, const T&, const T* x, T* g) const override {
    g[0] = mode == Mode::kRolling ? T(x[1] - slope_a * x[0]) : T(slope_b * x[0] - x[1]);
  }
  ResetResult Reset(Mode mode, int, const T&, T*) override {
    return {mode == Mode::kRolling ? Mode::kToe : Mode::kRolling};
  }
  double FirstStep(Mode, const T*) const override { return 1e-3; }
};

}  // namespace hoplab::testing
