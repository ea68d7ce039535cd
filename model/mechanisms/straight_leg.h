#pragma once

#include <cmath>

#include "model/laws/extended_leg.h"
#include "model/mechanisms/legged_body.h"

namespace hoplab {

/// The straight spring leg (thesis 4.3): F = k (l0 - l) - d dl/dt with the toe fixed in stance.
/// Mode: stance. The contact coordinate is x_c.
template <class T>
class StraightSpring {
 public:
  static constexpr bool kIsExpansion = false;

  explicit StraightSpring(const Parameters<T>& p)
      : m_(Value(p.m)), k_(p.k), l0_(p.l0), extended_(p, Law::kStraightLeg) {}

  template <class Other>
  void CopyHidden(const Other& other) {
    extended_.CopyRoot(other.extended());
  }
  void StartSearch(Mode, const double*) { extended_.StartRootAt(0.0); }

  T TouchdownHeight(const T& theta) const {
    using std::cos;
    return l0_ * cos(theta);
  }
  T ChordAngle(const T& theta) const { return theta; }
  T Stiffness(const LegLoad<T>&) const { return k_; }
  Mode Land(const T& theta, T* z) {
    using std::sin;
    z[kContact] = z[kX] + l0_ * sin(theta);
    extended_.StartRootAt(0.0);
    return Mode::kStance;
  }
  LegLoad<T> Load(Mode, const T* z) const {
    using std::sqrt;
    LegLoad<T> load;
    load.u = z[kContact] - z[kX];
    load.y = z[kY];
    load.l = sqrt(load.u * load.u + z[kY] * z[kY]);
    load.phi = T(0.0);
    load.elastic_force = k_ * (l0_ - load.l);
    load.damping_rate = (z[kY] * z[kVy] - load.u * z[kVx]) / load.l;
    load.contact_rate = T(0.0);
    return load;
  }
  T RestChord(const LegLoad<T>&) const { return l0_; }

  // One stance mode: nothing of its own to pass through.
  int OwnGuardCount(Mode) const { return 0; }
  GuardSpec OwnGuard(Mode, int) const { return {}; }
  void OwnGuards(Mode, const LegLoad<T>&, T*) const {}
  Mode Pass(EventKind, T*) const { return Mode::kStance; }

  T ShownAngle(Mode, const LegLoad<T>& load) const {
    using std::atan2;
    return atan2(load.u, load.y);
  }
  T ShownLength(const T&) const { return l0_; }

  T StrainEnergy(const LegLoad<T>& load) const { return 0.5 * load.elastic_force * (l0_ - load.l); }
  double Flexure(const LegLoad<T>&) const { return 0.0; }
  double Size() const { return Value(l0_); }
  T LowestHip() const { return 0.25 * l0_; }
  /// sqrt(m/k) [s].
  double TimeScale(const LegLoad<T>&) const { return std::sqrt(m_ / Value(k_)); }

  /// The same leg with the terms that effects bring into its law.
  const ExtendedLeg<T>& extended() const { return extended_; }

 private:
  double m_;
  T k_, l0_;
  ExtendedLeg<T> extended_;
};

}  // namespace hoplab
