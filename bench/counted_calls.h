#pragma once

#include "model/hybrid/run.h"

namespace hoplab::bench {

/// Calls of a mechanism's functions during a run, in any scalar type.
struct CallCounts {
  long derivatives = 0, guards = 0;
};
inline thread_local CallCounts call_counts;

/// A mechanism that counts how often it is called.
template <template <class> class Body>
struct Counted {
  template <class T>
  class Counting : public Body<T> {
   public:
    Counting(const Parameters<T>& p, const ActiveEffects<T>& effects, LiftoffRule liftoff)
        : Body<T>(p, effects, liftoff) {}
    void Derivative(Mode mode, const T& t, const T* z, T* dz) const {
      ++call_counts.derivatives;
      Body<T>::Derivative(mode, t, z, dz);
    }
    void Guards(Mode mode, const T& t, const T* z, T* g) const {
      ++call_counts.guards;
      Body<T>::Guards(mode, t, z, g);
    }
  };
};

/// What `request` costs in calls, without sensitivities, by the default integrator.
template <template <class> class Body>
CallCounts CountCalls(const SimulationRequest& request) {
  call_counts = {};
  Trajectory out;
  run_detail::RunChunk<Counted<Body>::template Counting, double, Dop853>(request, 0, 0, out);
  return call_counts;
}

}  // namespace hoplab::bench
