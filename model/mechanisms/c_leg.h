#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/laws/extended_leg.h"
#include "model/laws/sole.h"
#include "model/leg_compliance.h"
#include "model/mechanisms/leg.h"

namespace hoplab {

/// The half-circular compliant leg with one of its laws. Modes: rolling, toe. A leg that lands at
/// theta <= 0 lands on its toe.
template <class T, template <class> class LawT>
class CLeg final : public Leg<T> {
 public:
  static constexpr double kFallArc = 0.2;  // rad

  explicit CLeg(const Parameters<T>& p)
      : m_(Value(p.m)),
        r_(p.r),
        sole_(p.law_terms.sole),
        has_sole_(p.law_terms.sole_active),
        compliance_(p),
        law_(p),
        extended_(p, LawT<T>::kLaw) {}

  void SaveDiscreteState(DiscreteState& to) const override {
    law_.SaveRoot(to);
    extended_.SaveRoot(to);
  }
  void LoadDiscreteState(DiscreteState& from) override {
    law_.LoadRoot(from);
    extended_.LoadRoot(from);
  }
  /// The arc is searched from its unloaded geometry, y = r (1 - cos phi) over its sole.
  void StartSearch(Mode mode, const double* z) override {
    if (mode != Mode::kRolling) return StartRootAt(std::numbers::pi);
    const double height = z[kY] - Value(sole_);
    StartRootAt(std::acos(std::clamp(1.0 - height / Value(r_), -1.0, 1.0)));
  }

  T TouchdownHeight(const T& theta) const override {
    using std::cos;
    return Value(theta) > 0.0 ? T(r_ * (1.0 + cos(theta)) + sole_) : T(WholeLength() * cos(theta));
  }
  T ChordAngle(const T& theta) const override {
    using std::atan2;
    using std::sin;
    if (Value(theta) <= 0.0) return theta;
    return has_sole_ ? T(atan2(r_ * sin(theta), TouchdownHeight(theta))) : T(0.5 * theta);
  }
  /// k(phi) = 1/C(phi) at the rest radius, M3.
  T Stiffness(const LegLoad<T>& load) const override {
    const T bare = 1.0 / compliance_.ChordAt(load.phi);
    if (!has_sole_) return bare;
    const T spread = SoleAt(load.phi, r_, sole_).spread;
    return bare / (spread * spread);
  }
  Mode Land(const T& theta, T* z) override {
    using std::sin;
    if (Value(theta) <= 0.0) {
      z[kContact] = z[kX] + WholeLength() * sin(theta);
      StartRootAt(std::numbers::pi);
      return Mode::kToe;
    }
    const T phi = std::numbers::pi - theta;
    z[kContact] = law_.ContactCoordinate(z[kX] + r_ * sin(theta), phi) - sole_ * phi;
    StartRootAt(Value(phi));
    return Mode::kRolling;
  }
  /// Touch-down under a hip torque; `mode` as Land gave it.
  LegLoad<T> Load(Mode mode, const T* z) const override {
    return mode == Mode::kRolling ? law_.Rolling(z) : law_.Toe(z);
  }
  T RestChord(const LegLoad<T>& load) const override {
    using std::sin;
    return has_sole_ ? SoleAt(load.phi, r_, sole_).rest : T(2.0 * r_ * sin(0.5 * load.phi));
  }

  int OwnGuardCount(Mode mode) const override { return mode == Mode::kRolling ? 2 : 1; }
  GuardSpec OwnGuard(Mode mode, int i) const override {
    if (i == 1) return {EventKind::kFallArc, 1.0, Outcome::kFellArc};
    return {mode == Mode::kRolling ? EventKind::kRollingToToe : EventKind::kToeToRolling, 1.0};
  }
  void OwnGuards(Mode mode, const LegLoad<T>& load, T* g) const override {
    if (mode == Mode::kRolling)
      g[0] = law_.RollingToToe(load);
    else
      g[0] = -TipMiss(load);
    if (mode == Mode::kRolling) g[1] = load.phi - kFallArc;
  }
  Mode ResetStance(EventKind event, T* z) override {
    if (event == EventKind::kRollingToToe) {
      z[kContact] = law_.ToePosition(z[kContact]) + sole_ * std::numbers::pi;
      StartRootAt(std::numbers::pi);
      return Mode::kToe;
    }
    z[kContact] =
        law_.ContactCoordinate(z[kContact], T(std::numbers::pi)) - sole_ * std::numbers::pi;
    StartRootAt(std::numbers::pi);
    return Mode::kRolling;
  }

  /// What an encoder between body and leg reads: under `elastica` M93, else the circle's.
  T ShownAngle(Mode mode, const LegLoad<T>& load) const override {
    using std::asin;
    using std::atan2;
    const T chord = atan2(load.u, load.y);
    if constexpr (LawT<T>::kLaw == Law::kElastica) {
      if (mode == Mode::kRolling) return 2.0 * atan2(load.u, load.y - sole_);
      return chord + asin(load.u / load.l - TipMiss(load));
    }
    return mode == Mode::kRolling ? T(std::numbers::pi - load.phi) : chord;
  }
  T ShownLength(const T& theta) const override {
    using std::cos;
    using std::sqrt;
    if (Value(theta) <= 0.0) return WholeLength();
    if (!has_sole_) return 2.0 * r_ * cos(0.5 * theta);
    return sqrt(sole_ * sole_ + 2.0 * (r_ * (r_ + sole_) * (1.0 + cos(theta))));
  }
  T ShownArc(const LegLoad<T>& load) const override { return load.phi; }

  T StrainEnergy(const LegLoad<T>& load) const override { return law_.StrainEnergy(load); }
  bool IsExpansion() const override { return LawT<T>::kIsExpansion; }
  double DeflectionRatio(const LegLoad<T>& load) const override {
    return law_.DeflectionRatio(load);
  }
  double Size() const override { return Value(r_); }
  T LowestHip() const override { return 0.5 * r_; }
  /// sqrt(m C) [s].
  double TimeScale(const LegLoad<T>& load) const override {
    return std::sqrt(m_ * Value(compliance_.Chord(Value(load.phi))));
  }

  const LawT<T>& law() const { return law_; }
  /// The same leg with the terms that effects bring into its law.
  const ExtendedLeg<T>& extended() const override { return extended_; }

 private:
  /// From the hip to the ground under its toe, unloaded.
  T WholeLength() const { return 2.0 * r_ + sole_; }
  void StartRootAt(double phi) {
    law_.StartRootAt(phi);
    extended_.StartRootAt(phi);
  }

  /// Toe stance: u/l less the lead of a tip that begins to roll.
  T TipMiss(const LegLoad<T>& load) const {
    return extended_.active() ? load.tip_miss : T(-law_.ToeToRolling(load));
  }

  double m_;
  T r_;
  T sole_;  // M113
  bool has_sole_;
  LegCompliance<T> compliance_;
  LawT<T> law_;
  ExtendedLeg<T> extended_;
};

}  // namespace hoplab
