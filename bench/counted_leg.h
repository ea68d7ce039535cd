#pragma once

#include "model/hybrid/run.h"

namespace hoplab::bench {

/// Calls of a mechanism's functions during a run, in any scalar type.
struct CallCounts {
  long derivatives = 0, guards = 0;
};
inline thread_local CallCounts call_counts;

/// A mechanism that counts how often it is called.
template <template <class> class LegT>
struct Counted {
  template <class T>
  class Leg : public LegT<T> {
   public:
    using LegT<T>::LegT;
    void Derivative(Mode mode, const T& t, const T* z, T* dz) const {
      ++call_counts.derivatives;
      LegT<T>::Derivative(mode, t, z, dz);
    }
    void Guards(Mode mode, const T& t, const T* z, T* g) const {
      ++call_counts.guards;
      LegT<T>::Guards(mode, t, z, g);
    }
  };
};

/// What `request` costs in calls, without sensitivities, by the default integrator.
template <template <class> class LegT>
CallCounts CountCalls(const SimulationRequest& request) {
  call_counts = {};
  Trajectory out;
  run_detail::RunChunk<Counted<LegT>::template Leg, double, Dop853>(request, 0, 0, out);
  return call_counts;
}

}  // namespace hoplab::bench
