#pragma once

#include <cmath>
#include <limits>

#include "model/effects/active_effects.h"
#include "model/hybrid/automaton.h"
#include "model/hybrid/ballistic.h"
#include "model/laws/leg_load.h"
#include "model/mechanisms/speed_controller.h"
#include "model/observation.h"
#include "model/parameters.h"

namespace hoplab {

/// Cosine of the chord angle at which a leg counts as fallen (80 deg).
inline constexpr double kFallCosine = 0.17364817766693041;

/// A point mass on one massless leg (sections 3 and 4 of the equation sheet): flight, touch-down,
/// lift-off, apex, falls, hip torque and body forces. What carries the body in stance is `Leg`:
///   Leg(parameters)
///   Land(theta, z)          touch-down at leg angle theta: sets the contact, gives the stance mode
///   Settle(mode, z, conditions)  moves the contact of a landed leg that a torque bends
///   Load(mode, z)           LegLoad of a stance
///   RestChord(load)         chord length at which that leg carries nothing [m]
///   TouchdownHeight(theta)  height of the hip when a leg at that angle meets the ground [m]
///   ChordAngle(theta)       chord angle from the vertical at touch-down [rad]
///   Stiffness(load)         small-load chord stiffness there [N/m]
///   ShownAngle(mode, load), ShownLength(theta)  leg angle in stance, leg length in flight
///   StrainEnergy(load), Flexure(load), TimeScale(load)
///   extended()              the same leg where an effect adds to its law: Load, StrainEnergy
///   Size(), LowestHip()     a length of it; the default y_min [m]
///   OwnGuardCount(mode), OwnGuard(mode, i), OwnGuards(mode, load, g), Pass(event, z)
///                           its own events between stance modes: guards, and their resets
///   StartSearch(mode, z), CopyHidden(other)  where it searches a root
/// State: LegState. Modes: flight and those of the leg.
template <class T, template <class> class LegT>
class LeggedBody {
 public:
  using Scalar = T;
  static constexpr int kDim = kLegStateSize;

  LeggedBody(const Parameters<T>& parameters, const ActiveEffects<T>& effects, LiftoffRule liftoff)
      : p_(parameters),
        effects_(effects),
        liftoff_(liftoff),
        has_body_force_(effects.HasBodyForce()),
        has_chord_force_(effects.HasChordForce()),
        extended_(p_.law_terms.active),
        may_pull_(p_.law_terms.torque_active),
        leg_(p_),
        controller_(p_),
        y_min_(std::isnan(p_.fall_height) ? leg_.LowestHip() : T(p_.fall_height)) {}

  /// The discrete state that guards and rates depend on but derivatives do not.
  template <class Other>
  void CopyHidden(const Other& other) {
    leg_.CopyHidden(other.leg());
    controller_.set_saturation(other.controller().saturation());
  }
  /// Prepares for a state that did not come out of a run.
  void StartSearch(Mode mode, const double* z) { leg_.StartSearch(mode, z); }

  void Derivative(Mode mode, const T& t, const T* z, T* dz) const {
    T fx(0.0), fy(0.0);
    T contact_rate(0.0);
    if (mode != Mode::kFlight) {
      const LegLoad<T> load = Load(mode, t, z);
      const Vector2<T> force = HipForce(load, z);
      fx = force.x;
      fy = force.y;
      contact_rate = load.contact_rate;
      if (extended_) contact_rate -= load.slip_gain * p_.law_terms.foot_slip * force.x;  // M29
    }
    if (has_body_force_) {
      const Vector2<T> force = effects_.BodyForce({t, z[kX], z[kY], z[kVx], z[kVy]});
      fx += force.x;
      fy += force.y;
    }
    dz[kX] = z[kVx];
    dz[kY] = z[kVy];
    dz[kVx] = fx / p_.m;         // M13
    dz[kVy] = fy / p_.m - p_.g;  // M14
    dz[kContact] = contact_rate;
  }

  // Guards in stance: lift-off, the leg's own, fall by height, fall by angle, torque limit. Of two
  // at one instant the first fires first.
  int GuardCount(Mode mode) const {
    if (mode == Mode::kFlight) return 2;
    return 3 + leg_.OwnGuardCount(mode) + (controller_.limited() ? 1 : 0);
  }
  GuardSpec Guard(Mode mode, int i) const {
    const double weight = Value(p_.m) * std::max(Value(p_.g), 1.0), length = leg_.Size();
    if (mode == Mode::kFlight)
      return i == 0 ? GuardSpec{EventKind::kTouchdown, length} : GuardSpec{EventKind::kApex, 1.0};
    if (i == 0)
      return {EventKind::kLiftoff, liftoff_ == LiftoffRule::kZeroForce ? weight : length,
              may_pull_ ? std::nullopt : std::optional(Outcome::kNoSupport)};
    const int own = leg_.OwnGuardCount(mode);
    if (i <= own) return leg_.OwnGuard(mode, i - 1);
    switch (i - own) {
      case 1:
        return {EventKind::kFallHeight, length, Outcome::kFellHeight};
      case 2:
        return {EventKind::kFallAngle, 1.0, Outcome::kFellAngle};
      default:
        return {EventKind::kTorqueLimit, controller_.limit()};
    }
  }
  /// Guard functions, all crossing zero downward; the table of section 4.
  void Guards(Mode mode, const T& t, const T* z, T* g) const {
    if (mode == Mode::kFlight) {
      g[0] = z[kY] - TouchdownHeight(z);
      g[1] = z[kVy];
      return;
    }
    const LegLoad<T> load = Load(mode, t, z);
    g[0] =
        liftoff_ == LiftoffRule::kZeroForce ? ChordForce(load) : T(leg_.RestChord(load) - load.l);
    leg_.OwnGuards(mode, load, g + 1);
    g += 1 + leg_.OwnGuardCount(mode);
    g[0] = z[kY] - y_min_;
    g[1] = load.y / load.l - kFallCosine;
    if (controller_.limited()) g[2] = controller_.Guard(z[kVx]);
  }

  /// Reset map of guard `i`, applied to `z` in place.
  ResetResult Reset(Mode mode, int i, const T& t, T* z) {
    const EventKind event = Guard(mode, i).event;
    switch (event) {
      case EventKind::kTouchdown: {
        const T theta = TouchdownAngle(z);
        const Mode stance = leg_.Land(theta, z);
        ApplyLanding(theta, z);
        controller_.Enter(Value(z[kVx]));
        return {extended_ ? leg_.Settle(stance, z, Conditions(t, z)) : stance};
      }
      case EventKind::kLiftoff:
        z[kContact] = T(0.0);
        if (Value(z[kVy]) <= 0.0 && Value(z[kY] - TouchdownHeight(z)) < 0.0)
          return {Mode::kFlight, Outcome::kFellNoReturn};
        return {Mode::kFlight};
      case EventKind::kApex:
        if (Value(z[kY] - TouchdownHeight(z)) < 0.0) return {mode, Outcome::kFellNoReturn};
        return {mode};
      case EventKind::kTorqueLimit:
        controller_.Cross(Value(z[kVx]));
        return {mode};
      case EventKind::kFallHeight:
        return {mode, Outcome::kFellHeight};
      case EventKind::kFallAngle:
        return {mode, Outcome::kFellAngle};
      case EventKind::kFallArc:
        return {mode, Outcome::kFellArc};
      default:
        return {leg_.Pass(event, z)};
    }
  }

  /// Flight in closed form, where nothing pushes the body but gravity.
  bool IsBallistic(Mode mode) const { return mode == Mode::kFlight && !has_body_force_; }
  BallisticFlight<T> Ballistic(const T* z) const { return {T(0.0), T(-p_.g), TouchdownHeight(z)}; }

  /// First step of a mode [s]: in stance a tenth of a radian of the undamped oscillation.
  double FirstStep(Mode mode, const T* z) const {
    return mode == Mode::kFlight ? 0.01 : 0.1 * leg_.TimeScale(Load(mode, T(0.0), z));
  }

  /// What the sensors see, before the observation effects.
  Observation<T> Observe(Mode mode, const T& t, const T* z) const {
    Observation<T> seen;
    seen[Channel::kBodyX] = z[kX];
    seen[Channel::kBodyY] = z[kY];
    seen[Channel::kBodyVx] = z[kVx];
    seen[Channel::kBodyVy] = z[kVy];
    if (mode == Mode::kFlight) {
      const T theta = TouchdownAngle(z);
      seen[Channel::kLegAngle] = theta;
      seen[Channel::kLegLength] = leg_.ShownLength(theta);
      for (Channel c :
           {Channel::kGroundForceX, Channel::kGroundForceY, Channel::kHipTorque, Channel::kContact})
        seen[c] = T(0.0);
      return seen;
    }
    const LegLoad<T> load = Load(mode, t, z);
    const Vector2<T> force = HipForce(load, z);
    seen[Channel::kLegAngle] = leg_.ShownAngle(mode, load);
    seen[Channel::kLegLength] = load.l;
    seen[Channel::kGroundForceX] = force.x;
    seen[Channel::kGroundForceY] = force.y;
    seen[Channel::kHipTorque] = controller_.Torque(z[kVx]);
    seen[Channel::kContact] = T(1.0);
    return seen;
  }

  /// Kinetic, potential and strain energy [J]; the leg as stiff as at the start of the run.
  T Energy(Mode mode, const T* z) const {
    T energy = 0.5 * p_.m * (z[kVx] * z[kVx] + z[kVy] * z[kVy]) + p_.m * p_.g * z[kY];
    if (mode == Mode::kFlight) return energy;
    const LegLoad<T> load = Load(mode, T(0.0), z);
    if (extended_) return energy + leg_.extended().StrainEnergy(mode, load, Conditions(T(0.0), z));
    return energy + leg_.StrainEnergy(load);
  }
  /// F C/l0 in stance, where the law is an expansion in it; else 0.
  double Flexure(Mode mode, const T* z) const {
    if constexpr (!LegT<T>::kIsExpansion) return 0.0;
    return mode == Mode::kFlight ? 0.0 : leg_.Flexure(Load(mode, T(0.0), z));
  }

  const LegT<T>& leg() const { return leg_; }
  const SpeedController<T>& controller() const { return controller_; }

 private:
  LegConditions<T> Conditions(const T& t, const T* z) const {
    return {t, controller_.Torque(z[kVx])};
  }
  LegLoad<T> Load(Mode mode, const T& t, const T* z) const {
    if (extended_) return leg_.extended().Load(mode, z, Conditions(t, z));
    return leg_.Load(mode, z);
  }
  T TouchdownAngle(const T* z) const { return effects_.TouchdownAngle(z[kVx], p_.theta_td); }
  T TouchdownHeight(const T* z) const { return leg_.TouchdownHeight(TouchdownAngle(z)); }
  T ChordForce(const LegLoad<T>& load) const {
    T force = load.elastic_force - p_.d * load.damping_rate;  // M6, M12
    if (has_chord_force_)
      force += effects_.ChordForce({load.elastic_force, leg_.Stiffness(load), load.damping_rate});
    return force;
  }
  // What a touch-down at leg angle `theta` does to the velocity.
  void ApplyLanding(const T& theta, T* z) const {
    using std::cos;
    using std::sin;
    const T alpha = leg_.ChordAngle(theta);
    Vector2<T> velocity{z[kVx], z[kVy]};
    effects_.ChangeLandingVelocity({{-sin(alpha), cos(alpha)}}, velocity);
    z[kVx] = velocity.x;
    z[kVy] = velocity.y;
  }
  // F e + (T/l) n, the bracket of M13 and M14; by reaction, the ground's force on the leg.
  Vector2<T> HipForce(const LegLoad<T>& load, const T* z) const {
    const T chord = ChordForce(load) / load.l;
    const T normal = controller_.Torque(z[kVx]) / (load.l * load.l);
    return {normal * load.y - chord * load.u, chord * load.y + normal * load.u};
  }

  Parameters<T> p_;
  ActiveEffects<T> effects_;
  LiftoffRule liftoff_;
  bool has_body_force_, has_chord_force_, extended_;
  bool may_pull_;  // for a moment after touch-down, bent by the hip torque
  LegT<T> leg_;
  SpeedController<T> controller_;
  T y_min_;
};

}  // namespace hoplab
