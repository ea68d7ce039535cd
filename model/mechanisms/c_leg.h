#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/laws/extended_leg.h"
#include "model/laws/outline.h"
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
        terms_(p.law_terms),
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
    const double height = z[kY] - Value(terms_.sole);
    StartRootAt(std::acos(std::clamp(1.0 - height / Value(r_), -1.0, 1.0)));
  }

  T TouchdownHeight(const T& theta) const override {
    using std::cos;
    if (terms_.uneven_active) return ShownLength(theta) * cos(ChordAngle(theta));
    return Value(theta) > 0.0 ? T(r_ * (1.0 + cos(theta)) + terms_.sole)
                              : T(WholeLength() * cos(theta));
  }
  T ChordAngle(const T& theta) const override {
    using std::asin;
    using std::atan2;
    using std::sin;
    if (Value(theta) <= 0.0) return theta + TiltOfToe();
    if (terms_.uneven_active) return asin(OutlineOf(LandingArc(theta)).lead);
    return terms_.sole_active ? T(atan2(r_ * sin(theta), TouchdownHeight(theta))) : T(0.5 * theta);
  }
  /// k(phi) = 1/C(phi) at the rest radius, M3.
  T Stiffness(const LegLoad<T>& load) const override {
    const T bare = 1.0 / compliance_.ChordAt(load.phi);
    if (!terms_.HasOutline()) return bare;
    const T spread = OutlineOf(load.phi).spread;
    return bare / (spread * spread);
  }
  Mode Land(const T& theta, T* z) override {
    using std::sin;
    if (Value(theta) <= 0.0) {
      z[kContact] = z[kX] + WholeLength() * sin(ChordAngle(theta));
      StartRootAt(std::numbers::pi);
      return Mode::kToe;
    }
    const T phi = LandingArc(theta);
    const T lead =
        terms_.uneven_active ? T(ShownLength(theta) * sin(ChordAngle(theta))) : T(r_ * sin(theta));
    z[kContact] = law_.ContactCoordinate(z[kX] + lead, phi) - terms_.sole * phi;
    StartRootAt(Value(phi));
    return Mode::kRolling;
  }
  /// Touch-down under a hip torque; `mode` as Land gave it.
  LegLoad<T> Load(Mode mode, const T* z) const override {
    return mode == Mode::kRolling ? law_.Rolling(z) : law_.Toe(z);
  }
  T RestChord(const LegLoad<T>& load) const override {
    using std::sin;
    return terms_.HasOutline() ? OutlineOf(load.phi).rest : T(2.0 * r_ * sin(0.5 * load.phi));
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
      z[kContact] = law_.ToePosition(z[kContact]) + terms_.sole * std::numbers::pi;
      StartRootAt(std::numbers::pi);
      return Mode::kToe;
    }
    z[kContact] =
        law_.ContactCoordinate(z[kContact], T(std::numbers::pi)) - terms_.sole * std::numbers::pi;
    StartRootAt(std::numbers::pi);
    return Mode::kRolling;
  }

  /// What an encoder between body and leg reads: under `elastica` M93, else the circle's.
  T ShownAngle(Mode mode, const LegLoad<T>& load) const override {
    using std::asin;
    using std::atan2;
    const T chord = atan2(load.u, load.y);
    if constexpr (LawT<T>::kLaw == Law::kElastica) {
      const T shown = mode == Mode::kRolling ? T(2.0 * atan2(load.u, load.y - terms_.sole))
                                             : T(chord + asin(load.u / load.l - TipMiss(load)));
      return terms_.uneven_active ? T(shown - 2.0 * UnevenTilt(load.phi, terms_.uneven)) : shown;
    }
    if (mode != Mode::kRolling) return chord - TiltOfToe();
    const T turned = terms_.uneven_active ? UnevenArc<T>(load.phi, terms_.uneven).turned : load.phi;
    return std::numbers::pi - turned;
  }
  T ShownLength(const T& theta) const override {
    using std::cos;
    using std::sqrt;
    if (Value(theta) <= 0.0) return WholeLength();
    if (terms_.uneven_active) return OutlineOf(LandingArc(theta)).rest;
    if (!terms_.sole_active) return 2.0 * r_ * cos(0.5 * theta);
    const T& sole = terms_.sole;
    return sqrt(sole * sole + 2.0 * (r_ * (r_ + sole) * (1.0 + cos(theta))));
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
  T WholeLength() const { return 2.0 * r_ + terms_.sole; }
  Outline<T> OutlineOf(const T& phi) const { return OutlineAt(phi, r_, terms_); }
  // The contact arc of an unloaded leg at the angle theta.
  T LandingArc(const T& theta) const {
    const T angle = std::numbers::pi - theta;
    return terms_.uneven_active ? UnevenArcTurnedBy(angle, terms_.uneven) : angle;
  }
  // Angle of the unloaded chord from hip to toe against the leg's.
  T TiltOfToe() const {
    using std::asin;
    return terms_.uneven_active ? T(asin(OutlineOf(T(std::numbers::pi)).lead)) : T(0.0);
  }
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
  LawTerms<T> terms_;
  LegCompliance<T> compliance_;
  LawT<T> law_;
  ExtendedLeg<T> extended_;
};

}  // namespace hoplab
