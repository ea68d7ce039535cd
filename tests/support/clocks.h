#pragma once

#include "model/hybrid/hybrid_system.h"

namespace hoplab::testing {

/// Two clocks that run down together: guards z0 and z1, z0' = z1' = -1. In mode kRolling both are
/// watched; z0 at zero leads to kToe, where only z1 is.
template <class T>
struct TwoClocks final : HybridSystem<T> {
  int size() const override { return 2; }
  void Derivative(Mode, const T&, const T*, T* dz) const override { dz[0] = dz[1] = T(-1.0); }
  int GuardCount(Mode mode) const override { return mode == Mode::kRolling ? 2 : 1; }
  GuardSpec Guard(Mode mode, int i) const override {
    if (mode == Mode::kRolling && i == 0) return {EventKind::kRollingToToe, 1.0};
    return {EventKind::kLiftoff, 1.0};
  }
  void Guards(Mode mode, const T&, const T* z, T* g) const override {
    g[0] = mode == Mode::kRolling ? z[0] : z[1];
    g[1] = z[1];
  }
  ResetResult Reset(Mode mode, int i, const T&, T* z) override {
    if (mode == Mode::kRolling && i == 0) return {Mode::kToe};
    z[0] = z[1] = T(100.0);
    return {Mode::kToe};
  }
  double FirstStep(Mode, const T*) const override { return 0.1; }
};

/// Two clocks that run down together by pi of their way to -1 a second, each wound up by 1 where it
/// is at zero; steep guards.
template <class T>
struct WoundClocks final : HybridSystem<T> {
  int size() const override { return 2; }
  void Derivative(Mode, const T&, const T* z, T* dz) const override {
    for (int i = 0; i < 2; ++i) dz[i] = -3.14159 * (z[i] + 1.0);
  }
  int GuardCount(Mode) const override { return 2; }
  GuardSpec Guard(Mode, int i) const override {
    return {.event = EventKind::kTorqueLimit, .scale = 1.0, .leg = i};
  }
  void Guards(Mode, const T&, const T* z, T* g) const override {
    for (int i = 0; i < 2; ++i) g[i] = 700.0 * z[i];
  }
  ResetResult Reset(Mode mode, int i, const T&, T* z) override {
    z[i] += 1.0;
    return {mode};
  }
  double FirstStep(Mode, const T*) const override { return 0.01; }
};

/// z0' = 1 and two guards that open with z0 squared, less what rounding may leave where they begin:
/// of the value, or of the rate.
template <class T>
struct OpensSlowly final : HybridSystem<T> {
  static constexpr double kRounding = 1e-14;
  int size() const override { return 2; }
  void Derivative(Mode, const T&, const T*, T* dz) const override {
    dz[0] = T(1.0);
    dz[1] = T(0.0);
  }
  int GuardCount(Mode) const override { return 2; }
  GuardSpec Guard(Mode, int i) const override {
    return {i == 0 ? EventKind::kSlide : EventKind::kHipStop, 1.0};
  }
  void Guards(Mode, const T&, const T* z, T* g) const override {
    g[0] = Value(z[0]) == 0.0 ? T(kRounding * z[0]) : T(z[0] * z[0] - kRounding);
    g[1] = z[0] * z[0] - 1e-7 * z[0];
  }
  ResetResult Reset(Mode mode, int, const T&, T*) override { return {mode}; }
  double FirstStep(Mode, const T*) const override { return 1e-9; }
};

/// z0' = 1 and a guard, the speed of a foot that begins to slide, that opens with no rate, but for
/// rounding, and closes at 0.05, within the first step.
template <class T>
struct SlidesShortly final : HybridSystem<T> {
  int size() const override { return 2; }
  void Derivative(Mode, const T&, const T*, T* dz) const override {
    dz[0] = T(1.0);
    dz[1] = T(0.0);
  }
  int GuardCount(Mode mode) const override { return mode == Mode::kRolling ? 1 : 0; }
  GuardSpec Guard(Mode, int) const override { return {EventKind::kStick, 1.0}; }
  void Guards(Mode, const T&, const T* z, T* g) const override {
    g[0] = z[0] * z[0] * (1.0 - 20.0 * z[0]) - 1e-9 * z[0];
  }
  ResetResult Reset(Mode, int, const T&, T*) override { return {Mode::kToe}; }
  double FirstStep(Mode, const T*) const override { return 0.1; }
};

/// Two modes that each send the state back to the other at the same place: no way on.
template <class T>
struct BackAndForth final : HybridSystem<T> {
  int size() const override { return 2; }
  void Derivative(Mode, const T&, const T*, T* dz) const override { dz[0] = dz[1] = T(-1.0); }
  int GuardCount(Mode) const override { return 1; }
  GuardSpec Guard(Mode, int) const override { return {EventKind::kSwitch, 1.0}; }
  void Guards(Mode, const T&, const T* z, T* g) const override { g[0] = z[0]; }
  ResetResult Reset(Mode mode, int, const T&, T*) override {
    return {mode == Mode::kRolling ? Mode::kToe : Mode::kRolling};
  }
  double FirstStep(Mode, const T*) const override { return 0.1; }
};

/// A guard that dips below zero and back within a time far shorter than a step of the (trivially
/// smooth) flow: z0' = 1, guard (z0 - 1)^2 - depth.
template <class T>
struct Dip final : HybridSystem<T> {
  double depth = 1e-4;
  int size() const override { return 2; }
  void Derivative(Mode, const T&, const T*, T* dz) const override {
    dz[0] = T(1.0);
    dz[1] = T(0.0);
  }
  int GuardCount(Mode mode) const override { return mode == Mode::kRolling ? 1 : 0; }
  GuardSpec Guard(Mode, int) const override { return {EventKind::kSwitch, 1.0}; }
  void Guards(Mode, const T&, const T* z, T* g) const override {
    g[0] = (z[0] - 1.0) * (z[0] - 1.0) - depth;
  }
  ResetResult Reset(Mode, int, const T&, T*) override { return {Mode::kToe}; }
  double FirstStep(Mode, const T*) const override { return 10.0; }
};

/// A stance that loses its support as it changes: z0 at zero leads from kRolling to kToe and takes
/// 1 from z1, which is the lift-off guard of both and then stands closed. z0' = -rate.
template <class T>
struct LosesSupport final : HybridSystem<T> {
  T rate{1.0};
  int size() const override { return 2; }
  void Derivative(Mode, const T&, const T*, T* dz) const override {
    dz[0] = -rate;
    dz[1] = T(0.1);
  }
  int GuardCount(Mode mode) const override {
    return mode == Mode::kRolling ? 2 : mode == Mode::kToe;
  }
  GuardSpec Guard(Mode, int i) const override {
    if (i == 1) return {EventKind::kRollingToToe, 1.0};
    return {EventKind::kLiftoff, 1.0, Outcome::kNoSupport};
  }
  void Guards(Mode, const T&, const T* z, T* g) const override {
    g[0] = z[1];
    g[1] = z[0];
  }
  ResetResult Reset(Mode, int i, const T&, T* z) override {
    if (i == 0) return {Mode::kFlight};
    z[1] -= 1.0;
    return {Mode::kToe};
  }
  double FirstStep(Mode, const T*) const override { return 0.1; }
};

}  // namespace hoplab::testing
