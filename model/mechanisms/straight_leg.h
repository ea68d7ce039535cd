#pragma once

#include <cmath>
#include <limits>

#include "model/laws/extended_leg.h"
#include "model/mechanisms/leg.h"

namespace hoplab {

/// The straight spring leg (thesis 4.3): F = k (l0 - l) - d dl/dt with the toe fixed in stance.
/// Mode: stance. The contact coordinate is x_c. Where the leg pushes (`rest_length_step`) its rest
/// length is longer from greatest compression to lift-off: a discrete state.
template <class T>
class StraightSpring final : public Leg<T> {
 public:
  explicit StraightSpring(const Parameters<T>& p)
      : m_(Value(p.m)),
        k_(p.k),
        l0_(p.l0),
        pushed_length_(p.l0 + p.rest_length_step),
        pushes_(p.has_rest_length_step),
        extended_(p, Law::kStraightLeg) {}

  void SaveDiscreteState(DiscreteState& to) const override {
    extended_.SaveRoot(to);
    to.Put(pushed_);
  }
  void LoadDiscreteState(DiscreteState& from) override {
    extended_.LoadRoot(from);
    SetPushed(from.Take() != 0.0);
  }
  /// A stance in which the chord lengthens has had its greatest compression.
  void StartSearch(Mode mode, const double* z) override {
    extended_.StartRootAt(0.0);
    SetPushed(pushes_ && mode == Mode::kStance &&
              z[kY] * z[kVy] - (z[kContact] - z[kX]) * z[kVx] > 0.0);
  }

  T TouchdownHeight(const T& theta) const override {
    using std::cos;
    return l0_ * cos(theta);
  }
  T ChordAngle(const T& theta) const override { return theta; }
  T Stiffness(const LegLoad<T>&) const override { return k_; }
  Mode Land(const T& theta, T* z) override {
    using std::sin;
    SetPushed(false);
    z[kContact] = z[kX] + l0_ * sin(theta);
    extended_.StartRootAt(0.0);
    return Mode::kStance;
  }
  LegLoad<T> Load(Mode, const T* z) const override {
    using std::sqrt;
    LegLoad<T> load;
    load.u = z[kContact] - z[kX];
    load.y = z[kY];
    load.l = sqrt(load.u * load.u + z[kY] * z[kY]);
    load.phi = T(0.0);
    load.elastic_force = k_ * (RestLength() - load.l);
    load.damping_rate = (z[kY] * z[kVy] - load.u * z[kVx]) / load.l;
    load.contact_rate = T(0.0);
    return load;
  }
  T RestChord(const LegLoad<T>&) const override { return RestLength(); }

  // Greatest compression, -dl/dt; watched only where the leg changes there.
  int OwnGuardCount(Mode) const override { return pushes_ && !pushed_ ? 1 : 0; }
  GuardSpec OwnGuard(Mode, int) const override { return {EventKind::kMaxCompression, 1.0}; }
  void OwnGuards(Mode, const LegLoad<T>& load, T* g) const override {
    if (pushes_ && !pushed_) g[0] = -load.damping_rate;
  }
  Mode ResetStance(EventKind, T*) override {
    SetPushed(true);
    return Mode::kStance;
  }

  T ShownAngle(Mode, const LegLoad<T>& load) const override {
    using std::atan2;
    return atan2(load.u, load.y);
  }
  T ShownLength(const T&) const override { return l0_; }
  T ShownArc(const LegLoad<T>&) const override {
    return T(std::numeric_limits<double>::quiet_NaN());
  }

  T StrainEnergy(const LegLoad<T>& load) const override {
    return 0.5 * load.elastic_force * (RestLength() - load.l);
  }
  double Size() const override { return Value(l0_); }
  T LowestHip() const override { return 0.25 * l0_; }
  /// sqrt(m/k) [s].
  double TimeScale(const LegLoad<T>&) const override { return std::sqrt(m_ / Value(k_)); }

  /// The same leg with the terms that effects bring into its law.
  const ExtendedLeg<T>& extended() const override { return extended_; }

 private:
  const T& RestLength() const { return pushed_ ? pushed_length_ : l0_; }
  void SetPushed(bool pushed) {
    if (pushed_ == pushed) return;
    pushed_ = pushed;
    extended_.SetRestLength(RestLength());
  }

  double m_;
  T k_, l0_, pushed_length_;
  bool pushes_, pushed_ = false;
  ExtendedLeg<T> extended_;
};

}  // namespace hoplab
