#pragma once

#include <cmath>
#include <limits>

#include "model/effects/active_effects.h"
#include "model/hybrid/automaton.h"
#include "model/hybrid/ballistic.h"
#include "model/laws/leg_load.h"
#include "model/mechanisms/inertia.h"
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
/// State: LegState, and with kStates = kLaggedLegStateSize what the motor gives. Modes: flight and
/// those of the leg. On a slope everything is in the frame of the ground (GroundFrame).
template <class T, template <class> class LegT, int kStates = kLegStateSize>
class LeggedBody {
 public:
  using Scalar = T;
  static constexpr int kDim = kStates;
  static constexpr bool kLagged = kStates == kLaggedLegStateSize;

  LeggedBody(const Parameters<T>& parameters, const ActiveEffects<T>& effects, LiftoffRule liftoff)
      : p_(parameters),
        effects_(effects),
        liftoff_(liftoff),
        has_body_force_(effects.HasBodyForce()),
        has_chord_force_(effects.HasChordForce()),
        has_hip_torque_(effects.HasHipTorque()),
        has_quick_lag_(!kLagged && !IsZero(parameters.torque_lag)),
        // The touch-down angle moves in flight if it depends on a speed that does.
        flies_freely_(!has_body_force_ &&
                      (IsZero(parameters.slope) || !effects.HasTouchdownAngle())),
        extended_(p_.law_terms.active),
        may_pull_(p_.law_terms.torque_active),
        torque_lift_(p_.variant.torque_sign == ThesisVariant::TorqueSign::kPrinted ? -1.0 : 1.0),
        inertia_(p_),
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
      const Vector2<T> force = HipForce(load, HipTorque(mode, load, t, z));
      fx = force.x;
      fy = force.y;
      contact_rate = load.contact_rate;
      if (extended_) contact_rate -= load.slip_gain * p_.law_terms.foot_slip * force.x;  // M29
    }
    if (has_body_force_) {
      const Vector2<T> force = BodyForce(mode, t, z);
      fx += force.x;
      fy += force.y;
    }
    dz[kX] = z[kVx];
    dz[kY] = z[kVy];
    dz[kVx] = fx / inertia_.mx + inertia_.gravity_x;  // M13
    dz[kVy] = fy / inertia_.my + inertia_.gravity_y;  // M14
    dz[kContact] = contact_rate;
    if constexpr (kLagged) {
      dz[kMotorTorque] = T(0.0);
      if (mode != Mode::kFlight)
        dz[kMotorTorque] = (controller_.Torque(z[kVx]) - z[kMotorTorque]) / p_.torque_lag;
    }
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
    StanceGuards(mode, load, z, g);
  }
  /// Those of stance but for lift-off, g[0].
  void StanceGuards(Mode mode, const LegLoad<T>& load, const T* z, T* g) const {
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
      case EventKind::kTouchdown:
        return Land(TouchdownAngle(z), t, z, [](T*) {});
      case EventKind::kLiftoff:
        if (effects_.HasLiftoffVelocity()) ApplyLiftoff(Load(mode, t, z), z);
        z[kContact] = T(0.0);
        return LeftGround(z);
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
  bool IsBallistic(Mode mode) const { return mode == Mode::kFlight && flies_freely_; }
  BallisticFlight<T> Ballistic(const T* z) const {
    return {inertia_.gravity_x, inertia_.gravity_y, TouchdownHeight(z)};
  }

  /// First step of a mode [s]: in stance a tenth of a radian of the undamped oscillation, and no
  /// more than a lag of the torque.
  double FirstStep(Mode mode, const T* z) const {
    if (mode == Mode::kFlight) return 0.01;
    const double step = 0.1 * leg_.TimeScale(Load(mode, T(0.0), z));
    return kLagged ? std::min(step, Value(p_.torque_lag)) : step;
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
    const T torque = HipTorque(mode, load, t, z);
    const Vector2<T> force = HipForce(load, torque);
    seen[Channel::kLegAngle] = leg_.ShownAngle(mode, load);
    seen[Channel::kLegLength] = load.l;
    seen[Channel::kGroundForceX] = force.x;
    seen[Channel::kGroundForceY] = force.y;
    seen[Channel::kHipTorque] = torque;
    seen[Channel::kContact] = T(1.0);
    return seen;
  }

  /// Kinetic, potential and strain energy [J]; the leg as stiff as at the start of the run.
  T Energy(Mode mode, const T* z) const {
    const T energy = inertia_.Energy(z);
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
  const Inertia<T>& inertia() const { return inertia_; }
  const ActiveEffects<T>& effects() const { return effects_; }
  const T& lowest_hip() const { return y_min_; }

  // What a body on a leg with a toe mass asks, and does otherwise.

  /// Stance begins at leg angle `theta`; `move(z)` moves the contact from where an unloaded leg
  /// would have it.
  template <class Move>
  ResetResult Land(const T& theta, const T& t, T* z, const Move& move) {
    const Mode stance = leg_.Land(theta, z);
    move(z);
    ApplyLanding(theta, z);
    controller_.Enter(Value(z[kVx]));
    if constexpr (kLagged) z[kMotorTorque] = controller_.Torque(z[kVx]);
    return {extended_ ? leg_.Settle(stance, z, Conditions(t, z)) : stance};
  }
  /// Flight began: does it lead back to touch-down height?
  ResetResult LeftGround(const T* z) const {
    if (Value(z[kVy]) <= 0.0 && Value(z[kY] - TouchdownHeight(z)) < 0.0)
      return {Mode::kFlight, Outcome::kFellNoReturn};
    return {Mode::kFlight};
  }
  LegLoad<T> Load(Mode mode, const T& t, const T* z) const {
    if (extended_) return leg_.extended().Load(mode, z, Conditions(t, z));
    return leg_.Load(mode, z);
  }
  /// Force along the chord [N], positive pushes the hip away.
  T ChordForce(const LegLoad<T>& load) const {
    T force = load.elastic_force - p_.d * load.damping_rate;  // M6, M12
    if (has_chord_force_) {
      const T rest = leg_.RestChord(load);
      force += effects_.ChordForce(
          {load.elastic_force, leg_.Stiffness(load), load.damping_rate, T((rest - load.l) / rest)});
    }
    return force;
  }
  /// Leg angle the touch-down is commanded at.
  T TouchdownAngle(const T* z) const {
    return effects_.TouchdownAngle(z[kVx], p_.theta_td) - p_.slope;
  }
  /// Height of the hip at which a leg at that angle meets the ground [m].
  T TouchdownHeight(const T* z) const {
    return effects_.ContactHeight(leg_.TouchdownHeight(TouchdownAngle(z)));
  }
  Vector2<T> BodyForce(Mode mode, const T& t, const T* z) const {
    return effects_.BodyForce({t, z[kX], z[kY], z[kVx], z[kVy], mode != Mode::kFlight});
  }
  /// What a lift-off does to the velocity.
  void ApplyLiftoff(const LegLoad<T>& load, T* z) const {
    Vector2<T> velocity{z[kVx], z[kVy]};
    effects_.ChangeLiftoffVelocity({{-load.u / load.l, load.y / load.l}}, velocity);
    z[kVx] = velocity.x;
    z[kVy] = velocity.y;
  }

 private:
  // The torque that bends the leg; friction at the hip, which would have to know the load first, is
  // not in it.
  LegConditions<T> Conditions(const T& t, const T* z) const {
    T torque = MotorTorque(z);
    if (has_hip_torque_) effects_.AddHipTorque({torque, T(0.0), t, z[kVx]}, torque);
    return {t, torque};
  }
  // What the motor gives: its command, or with a lag long enough to integrate a state.
  T MotorTorque(const T* z) const {
    if constexpr (kLagged) return z[kMotorTorque];
    return controller_.Torque(z[kVx]);
  }
  // Torque on the hip: the motor's, and what effects add.
  T HipTorque(Mode mode, const LegLoad<T>& load, const T& t, const T* z) const {
    const T motor = MotorTorque(z);
    if (!has_quick_lag_) return WithTorqueEffects(motor, load, t, z);
    // A lag too short to integrate, to its first order: T_cmd - t_lag dT_cmd/dt.
    T fx = HipForce(load, WithTorqueEffects(motor, load, t, z)).x;
    if (has_body_force_) fx += BodyForce(mode, t, z).x;
    const T rate = controller_.TorqueRate(fx / inertia_.mx + inertia_.gravity_x);
    return WithTorqueEffects(motor - p_.torque_lag * rate, load, t, z);
  }
  T WithTorqueEffects(T torque, const LegLoad<T>& load, const T& t, const T* z) const {
    if (!has_hip_torque_) return torque;
    const T rate = -(load.y * z[kVx] + load.u * z[kVy]) / (load.l * load.l);
    const HipMotion<T> hip{torque, rate, t, z[kVx], load.u / load.l};
    effects_.AddHipTorque(hip, torque);
    return torque;
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
  // F e + (T/l) n, the bracket of M13 and M14 (M37); by reaction, the ground's force on the leg.
  Vector2<T> HipForce(const LegLoad<T>& load, const T& torque) const {
    const T chord = ChordForce(load) / load.l;
    const T normal = torque / (load.l * load.l);
    return {normal * load.y - chord * load.u, chord * load.y + torque_lift_ * normal * load.u};
  }

  Parameters<T> p_;
  ActiveEffects<T> effects_;
  LiftoffRule liftoff_;
  bool has_body_force_, has_chord_force_, has_hip_torque_, has_quick_lag_, flies_freely_, extended_;
  bool may_pull_;       // for a moment after touch-down, bent by the hip torque
  double torque_lift_;  // sign of the torque's vertical force: 1, or -1 (M37)
  Inertia<T> inertia_;
  LegT<T> leg_;
  SpeedController<T> controller_;
  T y_min_;
};

}  // namespace hoplab
