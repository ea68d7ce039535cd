#pragma once

#include <cmath>

#include "model/mechanisms/legged_body.h"

namespace hoplab {

/// The straight spring leg (thesis 4.3): F = k (l0 - l) - d dl/dt with the toe fixed in stance.
/// Mode: stance. The contact coordinate is x_c. Where the leg pushes (`rest_length_step`) its rest
/// length is longer from greatest compression to lift-off: a discrete state.
template <class T>
class StraightSpring {
 public:
  static constexpr bool kIsExpansion = false;

  explicit StraightSpring(const Parameters<T>& p)
      : m_(Value(p.m)),
        k_(p.k),
        l0_(p.l0),
        pushed_length_(p.l0 + p.rest_length_step),
        pushes_(p.has_rest_length_step) {}

  template <class Other>
  void CopyHidden(const Other& other) {
    extended_ = other.extended();
  }
  /// A stance in which the chord lengthens has had its greatest compression.
  void StartSearch(Mode mode, const double* z) {
    extended_ =
        pushes_ && mode == Mode::kStance && z[kY] * z[kVy] - (z[kContact] - z[kX]) * z[kVx] > 0.0;
  }

  T TouchdownHeight(const T& theta) const {
    using std::cos;
    return l0_ * cos(theta);
  }
  T ChordAngle(const T& theta) const { return theta; }
  T Stiffness(const LegLoad<T>&) const { return k_; }
  Mode Land(const T& theta, T* z) {
    using std::sin;
    extended_ = false;
    z[kContact] = z[kX] + l0_ * sin(theta);
    return Mode::kStance;
  }
  LegLoad<T> Load(Mode, const T* z) const {
    using std::sqrt;
    LegLoad<T> load;
    load.u = z[kContact] - z[kX];
    load.l = sqrt(load.u * load.u + z[kY] * z[kY]);
    load.phi = T(0.0);
    load.elastic_force = k_ * (RestLength() - load.l);
    load.damping_rate = (z[kY] * z[kVy] - load.u * z[kVx]) / load.l;
    load.contact_rate = T(0.0);
    return load;
  }
  T RestChord(const LegLoad<T>&) const { return RestLength(); }

  // Greatest compression, -dl/dt; watched only where the leg changes there.
  int OwnGuardCount(Mode) const { return pushes_ && !extended_ ? 1 : 0; }
  GuardSpec OwnGuard(Mode, int) const { return {EventKind::kMaxCompression, 1.0}; }
  void OwnGuards(Mode, const LegLoad<T>& load, T* g) const {
    if (pushes_ && !extended_) g[0] = -load.damping_rate;
  }
  Mode Pass(EventKind, T*) {
    extended_ = true;
    return Mode::kStance;
  }

  T ShownAngle(Mode, const LegLoad<T>& load, const T* z) const {
    using std::atan2;
    return atan2(load.u, z[kY]);
  }
  T ShownLength(const T&) const { return l0_; }

  T StrainEnergy(const LegLoad<T>& load) const {
    return 0.5 * load.elastic_force * (RestLength() - load.l);
  }
  double Flexure(const LegLoad<T>&) const { return 0.0; }
  double Size() const { return Value(l0_); }
  T LowestHip() const { return 0.25 * l0_; }
  /// sqrt(m/k) [s].
  double TimeScale(Mode, const T*) const { return std::sqrt(m_ / Value(k_)); }

  bool extended() const { return extended_; }

 private:
  const T& RestLength() const { return extended_ ? pushed_length_ : l0_; }

  double m_;
  T k_, l0_, pushed_length_;
  bool pushes_, extended_ = false;
};

}  // namespace hoplab
