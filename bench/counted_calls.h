#pragma once

#include <memory>

#include "model/mechanisms/leg.h"
#include "model/run.h"

namespace hoplab::bench {

/// Calls of a mechanism's functions during a run, in any scalar type.
struct CallCounts {
  long derivatives = 0, guards = 0;
};
inline thread_local CallCounts call_counts;

/// A leg that counts how often it is called.
template <class T>
class CountingBody final : public HybridSystem<T> {
 public:
  explicit CountingBody(const MechanismSetup<T>& setup)
      : storage_(std::make_unique<SystemStorage<T>>()) {
    LegLawOf(setup.law).body.Make(setup, *storage_);
  }

  int size() const override { return (*storage_)->size(); }
  void Derivative(Mode mode, const T& t, const T* z, T* dz) const override {
    ++call_counts.derivatives;
    (*storage_)->Derivative(mode, t, z, dz);
  }
  int GuardCount(Mode mode) const override { return (*storage_)->GuardCount(mode); }
  GuardSpec Guard(Mode mode, int i) const override { return (*storage_)->Guard(mode, i); }
  void Guards(Mode mode, const T& t, const T* z, T* g) const override {
    ++call_counts.guards;
    (*storage_)->Guards(mode, t, z, g);
  }
  ResetResult Reset(Mode mode, int i, const T& t, T* z) override {
    return (*storage_)->Reset(mode, i, t, z);
  }
  void SaveDiscreteState(DiscreteState& to) const override { (*storage_)->SaveDiscreteState(to); }
  void LoadDiscreteState(DiscreteState& from) override { (*storage_)->LoadDiscreteState(from); }
  bool IsBallistic(Mode mode) const override { return (*storage_)->IsBallistic(mode); }
  BallisticFlight<T> Ballistic(const T* z) const override { return (*storage_)->Ballistic(z); }
  double FirstStep(Mode mode, const T* z) const override { return (*storage_)->FirstStep(mode, z); }

 private:
  std::unique_ptr<SystemStorage<T>> storage_;
};

/// What `request` costs in calls, by the default integrator.
inline CallCounts CountCalls(const SimulationRequest& request) {
  call_counts = {};
  Trajectory out;
  RunRequest(request, MakeMechanism<CountingBody>(), out);
  return call_counts;
}

}  // namespace hoplab::bench
