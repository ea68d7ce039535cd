#pragma once

namespace hoplab {

/// A right-hand side without its type: dy/dt of a flat vector [state | sensitivities], for the
/// solvers that are compiled once.
struct FlatSystem {
  void (*derivative)(const void* context, double t, const double* y, double* dy);
  const void* context;
  int size;        // of the whole vector
  int controlled;  // leading components that steer the step: the state
};

template <int kSize, int kControlled, class Rhs>
FlatSystem MakeFlatSystem(const Rhs& rhs) {
  return {[](const void* context, double t, const double* y, double* dy) {
            (*static_cast<const Rhs*>(context))(t, y, dy);
          },
          &rhs, kSize, kControlled};
}

}  // namespace hoplab
