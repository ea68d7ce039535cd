#pragma once

#include "model/hybrid/automaton.h"
#include "model/jet.h"

namespace hoplab {

/// Right-hand side of the state and its sensitivities in one flat vector
/// [z_0 .. z_{n-1} | dz_0/dp_0 .. dz_0/dp_{N-1} | dz_1/dp_0 ..]: dS/dt = f_x S + f_p by duals.
template <class System>
class AugmentedRightHandSide {
 public:
  using T = typename System::Scalar;
  static constexpr int kDim = System::kDim;
  static constexpr int kWidth = kJetWidth<T>;
  static constexpr int kSize = kDim * (1 + kWidth);

  AugmentedRightHandSide(const System* system, const Mode* mode) : system_(system), mode_(mode) {}

  void operator()(double t, const double* y, double* dy) const {
    if constexpr (kWidth == 0) {
      system_->Derivative(*mode_, t, y, dy);
    } else {
      T z[kDim], dz[kDim];
      Unpack(y, z);
      system_->Derivative(*mode_, T(t), z, dz);
      Pack(dz, dy);
    }
  }

  static void Unpack(const double* y, T* z) {
    for (int i = 0; i < kDim; ++i) {
      z[i] = T(y[i]);
      if constexpr (kWidth > 0) {
        for (int k = 0; k < kWidth; ++k) z[i].v[k] = y[kDim + i * kWidth + k];
      }
    }
  }
  static void Pack(const T* z, double* y) {
    for (int i = 0; i < kDim; ++i) {
      y[i] = Value(z[i]);
      if constexpr (kWidth > 0) {
        for (int k = 0; k < kWidth; ++k) y[kDim + i * kWidth + k] = z[i].v[k];
      }
    }
  }

 private:
  const System* system_;
  const Mode* mode_;
};

}  // namespace hoplab
