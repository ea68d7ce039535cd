#pragma once

#include "model/jet.h"

namespace hoplab {

/// The state of a mechanism and its sensitivities in one flat vector
/// [z_0 .. z_{n-1} | dz_0/dp_0 .. dz_0/dp_{N-1} | dz_1/dp_0 ..].
template <class T>
void Unpack(const double* y, int states, T* z) {
  constexpr int kWidth = kJetWidth<T>;
  for (int i = 0; i < states; ++i) {
    if constexpr (kWidth == 0) {
      z[i] = y[i];
    } else {
      z[i].a = y[i];
      for (int k = 0; k < kWidth; ++k) z[i].v[k] = y[states + i * kWidth + k];
    }
  }
}
template <class T>
void Pack(const T* z, int states, double* y) {
  constexpr int kWidth = kJetWidth<T>;
  for (int i = 0; i < states; ++i) {
    y[i] = Value(z[i]);
    if constexpr (kWidth > 0) {
      for (int k = 0; k < kWidth; ++k) y[states + i * kWidth + k] = z[i].v[k];
    }
  }
}

}  // namespace hoplab
