#pragma once

#include <algorithm>
#include <numbers>
#include <span>

#include "model/laws/leg_load.h"
#include "model/mechanisms/leg_common.h"
#include "model/observation.h"

namespace hoplab {

/// The half-circular compliant leg on a point mass (sections 3 and 4 of the equation sheet), with
/// one of its laws. State: LegState. Modes: flight, rolling, toe.
template <class T, template <class> class LawT>
class CLeg {
 public:
  using Scalar = T;
  static constexpr int kDim = kLegStateSize;
  static constexpr double kFallArc = 0.2;  // rad

  CLeg(const Parameters<T>& parameters, const ActiveEffects<T>& effects, LiftoffRule liftoff)
      : p_(parameters), effects_(effects), liftoff_(liftoff),
        has_body_force_(effects.HasBodyForce()), law_(p_), controller_(p_),
        y_min_(std::isnan(p_.fall_height) ? T(0.5 * p_.r) : T(p_.fall_height)) {}

  /// The discrete state that guards and rates depend on but derivatives do not.
  template <class Other>
  void CopyHidden(const Other& other) {
    law_.CopyRoot(other.law());
    controller_.set_saturation(other.controller().saturation());
  }

  /// Prepares for a state that did not come out of a run: the arc is searched from its unloaded
  /// geometry.
  void StartSearch(Mode mode, const double* z) {
    // Unloaded: y = r (1 - cos phi).
    if (mode == Mode::kRolling)
      law_.StartRootAt(std::acos(std::clamp(1.0 - z[kY] / Value(p_.r), -1.0, 1.0)));
  }

  void Derivative(Mode mode, const T& t, const T* z, T* dz) const {
    T fx(0.0), fy(0.0);
    T contact_rate(0.0);
    if (mode != Mode::kFlight) {
      const LegLoad<T> load = Load(mode, z);
      const Vector2<T> force = HipForce(load, z);
      fx = force.x;
      fy = force.y;
      contact_rate = load.contact_rate;
    }
    if (has_body_force_) {
      const Vector2<T> force = effects_.BodyForce({t, z[kX], z[kY], z[kVx], z[kVy]});
      fx += force.x;
      fy += force.y;
    }
    dz[kX] = z[kVx];
    dz[kY] = z[kVy];
    dz[kVx] = fx / p_.m;        // M13
    dz[kVy] = fy / p_.m - p_.g; // M14
    dz[kContact] = contact_rate;
  }

  int GuardCount(Mode mode) const {
    if (mode == Mode::kFlight) return 2;
    return (mode == Mode::kRolling ? 5 : 4) + (controller_.limited() ? 1 : 0);
  }
  GuardSpec Guard(Mode mode, int i) const {
    const double weight = Value(p_.m) * std::max(Value(p_.g), 1.0), length = Value(p_.r);
    if (mode == Mode::kFlight)
      return i == 0 ? GuardSpec{EventKind::kTouchdown, length} : GuardSpec{EventKind::kApex, 1.0};
    switch (i) {
      case 0:
        return {EventKind::kLiftoff, liftoff_ == LiftoffRule::kZeroForce ? weight : length, true};
      case 1:
        return {mode == Mode::kRolling ? EventKind::kRollingToToe : EventKind::kToeToRolling, 1.0};
      case 2: return {EventKind::kFallHeight, length};
      case 3: return {EventKind::kFallAngle, 1.0};
      case 4:
        if (mode == Mode::kRolling) return {EventKind::kFallArc, 1.0};
        [[fallthrough]];
      default: return {EventKind::kTorqueLimit, controller_.limit()};
    }
  }
  /// Guard functions, all crossing zero downward; the table of section 4.
  void Guards(Mode mode, const T&, const T* z, T* g) const {
    if (mode == Mode::kFlight) {
      g[0] = z[kY] - TouchdownHeight(z);
      g[1] = z[kVy];
      return;
    }
    const LegLoad<T> load = Load(mode, z);
    g[0] = liftoff_ == LiftoffRule::kZeroForce ? ChordForce(load) : T(RestChord(load) - load.l);
    g[1] = mode == Mode::kRolling ? law_.RollingToToe(load) : law_.ToeToRolling(load);
    g[2] = z[kY] - y_min_;
    g[3] = z[kY] / load.l - kFallCosine;
    int next = 4;
    if (mode == Mode::kRolling) g[next++] = load.phi - kFallArc;
    if (controller_.limited()) g[next] = controller_.Guard(z[kVx]);
  }

  /// Reset map of guard `i`, applied to `z` in place.
  ResetResult Reset(Mode mode, int i, const T&, T* z) {
    switch (Guard(mode, i).event) {
      case EventKind::kTouchdown: {
        using std::sin;
        const T theta = effects_.TouchdownAngle(z[kVx], p_.theta_td);
        controller_.Enter(Value(z[kVx]));
        if (Value(theta) <= 0.0) {
          z[kContact] = z[kX] + 2.0 * p_.r * sin(theta);
          return {Mode::kToe};
        }
        const T phi = std::numbers::pi - theta;
        z[kContact] = law_.ContactCoordinate(z[kX] + p_.r * sin(theta), phi);
        law_.StartRootAt(Value(phi));
        return {Mode::kRolling};
      }
      case EventKind::kRollingToToe:
        z[kContact] = law_.ToePosition(z[kContact]);
        return {Mode::kToe};
      case EventKind::kToeToRolling:
        z[kContact] = law_.ContactCoordinate(z[kContact], T(std::numbers::pi));
        law_.StartRootAt(std::numbers::pi);
        return {Mode::kRolling};
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
      case EventKind::kFallHeight: return {mode, Outcome::kFellHeight};
      case EventKind::kFallAngle: return {mode, Outcome::kFellAngle};
      default: return {mode, Outcome::kFellArc};
    }
  }

  /// Flight in closed form, where nothing pushes the body but gravity.
  bool IsBallistic(Mode mode) const { return mode == Mode::kFlight && !has_body_force_; }
  BallisticFlight<T> Ballistic(const T* z) const {
    return {T(0.0), T(-p_.g), TouchdownHeight(z)};
  }

  /// First step of a stance [s]: a tenth of a radian of the undamped oscillation m, C.
  double FirstStep(Mode mode, const T* z) const {
    if (mode == Mode::kFlight) return 0.01;
    const double phi = Value(Load(mode, z).phi);
    const double C = Value(LegCompliance<T>(p_).Chord(phi));
    return 0.1 * std::sqrt(Value(p_.m) * C);
  }

  /// What the sensors see, before the observation effects.
  Observation<T> Observe(Mode mode, const T&, const T* z) const {
    Observation<T> seen = BodyObservation(z);
    if (mode == Mode::kFlight) {
      using std::cos;
      const T theta = effects_.TouchdownAngle(z[kVx], p_.theta_td);
      seen[Channel::kLegAngle] = theta;
      seen[Channel::kLegLength] =
          Value(theta) > 0.0 ? T(2.0 * p_.r * cos(0.5 * theta)) : T(2.0 * p_.r);
      for (Channel c : {Channel::kGroundForceX, Channel::kGroundForceY, Channel::kHipTorque,
                        Channel::kContact})
        seen[c] = T(0.0);
      return seen;
    }
    using std::atan2;
    const LegLoad<T> load = Load(mode, z);
    const Vector2<T> force = HipForce(load, z);
    seen[Channel::kLegAngle] =
        mode == Mode::kRolling ? T(std::numbers::pi - load.phi) : T(atan2(load.u, z[kY]));
    seen[Channel::kLegLength] = load.l;
    seen[Channel::kGroundForceX] = force.x;
    seen[Channel::kGroundForceY] = force.y;
    seen[Channel::kHipTorque] = controller_.Torque(z[kVx]);
    seen[Channel::kContact] = T(1.0);
    return seen;
  }

  /// Kinetic, potential and strain energy [J].
  T Energy(Mode mode, const T* z) const {
    T energy = 0.5 * p_.m * (z[kVx] * z[kVx] + z[kVy] * z[kVy]) + p_.m * p_.g * z[kY];
    if (mode != Mode::kFlight) energy += law_.StrainEnergy(Load(mode, z));
    return energy;
  }
  /// F C/l0 in stance, where the law is an expansion in it; else 0.
  double Flexure(Mode mode, const T* z) const {
    return mode == Mode::kFlight ? 0.0 : law_.Flexure(Load(mode, z));
  }

  const LawT<T>& law() const { return law_; }
  const SpeedController<T>& controller() const { return controller_; }

 private:
  LegLoad<T> Load(Mode mode, const T* z) const {
    return mode == Mode::kRolling ? law_.Rolling(z) : law_.Toe(z);
  }
  T ChordForce(const LegLoad<T>& load) const {
    return load.elastic_force - p_.d * load.damping_rate;  // M6, M12
  }
  T RestChord(const LegLoad<T>& load) const {
    using std::sin;
    return 2.0 * p_.r * sin(0.5 * load.phi);
  }
  // F e + (T/l) n, the bracket of M13 and M14; by reaction, the ground's force on the leg.
  Vector2<T> HipForce(const LegLoad<T>& load, const T* z) const {
    const T chord = ChordForce(load) / load.l;
    const T normal = controller_.Torque(z[kVx]) / (load.l * load.l);
    return {normal * z[kY] - chord * load.u, chord * z[kY] + normal * load.u};
  }
  // Height of the hip at which the leg, waiting at its touch-down angle, meets the ground.
  T TouchdownHeight(const T* z) const {
    using std::cos;
    const T theta = effects_.TouchdownAngle(z[kVx], p_.theta_td);
    return Value(theta) > 0.0 ? T(p_.r * (1.0 + cos(theta))) : T(2.0 * p_.r * cos(theta));
  }
  static Observation<T> BodyObservation(const T* z) {
    Observation<T> seen;
    seen[Channel::kBodyX] = z[kX];
    seen[Channel::kBodyY] = z[kY];
    seen[Channel::kBodyVx] = z[kVx];
    seen[Channel::kBodyVy] = z[kVy];
    return seen;
  }

  Parameters<T> p_;
  ActiveEffects<T> effects_;
  LiftoffRule liftoff_;
  bool has_body_force_;
  LawT<T> law_;
  SpeedController<T> controller_;
  T y_min_;
};

}  // namespace hoplab
