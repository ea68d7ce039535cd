#pragma once

#include <algorithm>

#include "model/hybrid/event_location.h"
#include "model/hybrid/hybrid_system.h"

namespace hoplab {

/// Reads a run at the rows of a trace.
template <class T>
class RowReader {
 public:
  virtual ~RowReader() = default;
  virtual int count() const { return 0; }
  /// The time row `i` was really read at [s], ascending: an observation effect may shift it.
  virtual T Time(int /*i*/) const { return T(0.0); }
  virtual void Read(int /*i*/, Mode /*mode*/, const T& /*time*/, const T* /*z*/) {}
};

/// Which row of a trace comes next, and the state it is read from.
template <class T>
class RowCursor {
 public:
  RowCursor(RowReader<T>& rows, const HybridSystem<T>& system, GuardWatch& watch)
      : rows_(rows), system_(system), watch_(watch), states_(system.size()) {}

  /// Rows passed so far.
  int passed() const { return next_; }
  void Reset(int row) { next_ = row; }
  /// How many rows lie before the start of the run.
  int BeforeStart() const {
    int before = 0;
    while (before < rows_.count() && Value(rows_.Time(before)) < 0.0) ++before;
    return before;
  }
  T TimeOf(int row) const { return rows_.Time(row); }

  /// Rows up to `until` on a flight in closed form that left `from` at `begin`.
  void OnFlight(const BallisticFlight<T>& flight, Mode mode, double begin, const T* from,
                double until) {
    T z[kMaxStates];
    for (; next_ < rows_.count(); ++next_) {
      const T time = rows_.Time(next_);
      if (Value(time) > until) return;
      std::copy_n(from, states_, z);
      flight.Advance(time - begin, z);
      rows_.Read(next_, mode, time, z);
    }
  }
  /// Rows up to `until` of which `state_at(t, z)` gives the state at the time's value.
  template <class StateAt>
  void Through(Mode mode, double until, const StateAt& state_at) {
    T z[kMaxStates];
    for (; next_ < rows_.count(); ++next_) {
      const T time = rows_.Time(next_);
      if (Value(time) > until) return;
      state_at(Value(time), z);
      Emit(next_, mode, time, z);
    }
  }
  /// One row at the value of its time: the state is moved along the flow by the time's derivative.
  void Emit(int row, Mode mode, const T& time, T* z) {
    if constexpr (kJetWidth < T >> 0) {
      if (!time.v.isZero()) {
        double value[kMaxStates], f[kMaxStates];
        for (int i = 0; i < states_; ++i) value[i] = Value(z[i]);
        watch_.Follow(system_);
        watch_.Flow(mode, Value(time), value, f);
        for (int i = 0; i < states_; ++i) z[i] += f[i] * (time - Value(time));
      }
    }
    rows_.Read(row, mode, time, z);
  }
  /// The next row's time, if that comes before `limit`.
  double NextTime(double after, double limit) const {
    for (int row = next_; row < rows_.count(); ++row) {
      const double time = Value(rows_.Time(row));
      if (time > after) return std::min(limit, time);
    }
    return limit;
  }

 private:
  RowReader<T>& rows_;
  const HybridSystem<T>& system_;
  GuardWatch& watch_;
  int states_;
  int next_ = 0;
};

}  // namespace hoplab
