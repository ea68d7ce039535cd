#pragma once

#include "model/laws/leg_load.h"
#include "model/mechanisms/leg_common.h"
#include "model/observation.h"

namespace hoplab {

/// The straight spring leg on a point mass (thesis 4.3): F = k (l0 - l) - d dl/dt with the toe
/// fixed in stance. State: LegState, the contact coordinate is x_c. Modes: flight, stance.
template <class T>
class StraightLeg {
 public:
  using Scalar = T;
  static constexpr int kDim = kLegStateSize;

  StraightLeg(const Parameters<T>& parameters, const ActiveEffects<T>& effects,
              LiftoffRule liftoff)
      : p_(parameters), effects_(effects), liftoff_(liftoff),
        has_body_force_(effects.HasBodyForce()), controller_(p_),
        y_min_(std::isnan(p_.fall_height) ? T(0.25 * p_.l0) : T(p_.fall_height)) {}

  template <class Other>
  void CopyHidden(const Other& other) {
    controller_.set_saturation(other.controller().saturation());
  }

  void StartSearch(Mode, const double*) {}

  void Derivative(Mode mode, const T& t, const T* z, T* dz) const {
    T fx(0.0), fy(0.0);
    if (mode != Mode::kFlight) {
      const Vector2<T> force = HipForce(Chord(z), z);
      fx = force.x;
      fy = force.y;
    }
    if (has_body_force_) {
      const Vector2<T> force = effects_.BodyForce({t, z[kX], z[kY], z[kVx], z[kVy]});
      fx += force.x;
      fy += force.y;
    }
    dz[kX] = z[kVx];
    dz[kY] = z[kVy];
    dz[kVx] = fx / p_.m;
    dz[kVy] = fy / p_.m - p_.g;
    dz[kContact] = T(0.0);
  }

  int GuardCount(Mode mode) const {
    return mode == Mode::kFlight ? 2 : 3 + (controller_.limited() ? 1 : 0);
  }
  GuardSpec Guard(Mode mode, int i) const {
    const double weight = Value(p_.m) * std::max(Value(p_.g), 1.0), length = Value(p_.l0);
    if (mode == Mode::kFlight)
      return i == 0 ? GuardSpec{EventKind::kTouchdown, length} : GuardSpec{EventKind::kApex, 1.0};
    switch (i) {
      case 0:
        return {EventKind::kLiftoff, liftoff_ == LiftoffRule::kZeroForce ? weight : length, true};
      case 1: return {EventKind::kFallHeight, length};
      case 2: return {EventKind::kFallAngle, 1.0};
      default: return {EventKind::kTorqueLimit, controller_.limit()};
    }
  }
  void Guards(Mode mode, const T&, const T* z, T* g) const {
    if (mode == Mode::kFlight) {
      g[0] = z[kY] - TouchdownHeight(z);
      g[1] = z[kVy];
      return;
    }
    const ChordState c = Chord(z);
    g[0] = liftoff_ == LiftoffRule::kZeroForce ? c.force : T(p_.l0 - c.l);
    g[1] = z[kY] - y_min_;
    g[2] = z[kY] / c.l - kFallCosine;
    if (controller_.limited()) g[3] = controller_.Guard(z[kVx]);
  }

  ResetResult Reset(Mode mode, int i, const T&, T* z) {
    switch (Guard(mode, i).event) {
      case EventKind::kTouchdown: {
        using std::sin;
        z[kContact] = z[kX] + p_.l0 * sin(effects_.TouchdownAngle(z[kVx], p_.theta_td));
        controller_.Enter(Value(z[kVx]));
        return {Mode::kStance};
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
      case EventKind::kFallHeight: return {mode, Outcome::kFellHeight};
      default: return {mode, Outcome::kFellAngle};
    }
  }

  bool IsBallistic(Mode mode) const { return mode == Mode::kFlight && !has_body_force_; }
  BallisticFlight<T> Ballistic(const T* z) const {
    return {T(0.0), T(-p_.g), TouchdownHeight(z)};
  }
  double FirstStep(Mode mode, const T*) const {
    return mode == Mode::kFlight ? 0.01 : 0.1 * std::sqrt(Value(p_.m / p_.k));
  }

  Observation<T> Observe(Mode mode, const T&, const T* z) const {
    Observation<T> seen;
    seen[Channel::kBodyX] = z[kX];
    seen[Channel::kBodyY] = z[kY];
    seen[Channel::kBodyVx] = z[kVx];
    seen[Channel::kBodyVy] = z[kVy];
    const bool stance = mode != Mode::kFlight;
    seen[Channel::kContact] = T(stance ? 1.0 : 0.0);
    if (!stance) {
      seen[Channel::kLegAngle] = effects_.TouchdownAngle(z[kVx], p_.theta_td);
      seen[Channel::kLegLength] = p_.l0;
      for (Channel c : {Channel::kGroundForceX, Channel::kGroundForceY, Channel::kHipTorque})
        seen[c] = T(0.0);
      return seen;
    }
    using std::atan2;
    const ChordState c = Chord(z);
    const Vector2<T> force = HipForce(c, z);
    seen[Channel::kLegAngle] = atan2(c.u, z[kY]);
    seen[Channel::kLegLength] = c.l;
    seen[Channel::kGroundForceX] = force.x;
    seen[Channel::kGroundForceY] = force.y;
    seen[Channel::kHipTorque] = controller_.Torque(z[kVx]);
    return seen;
  }

  T Energy(Mode mode, const T* z) const {
    T energy = 0.5 * p_.m * (z[kVx] * z[kVx] + z[kVy] * z[kVy]) + p_.m * p_.g * z[kY];
    if (mode != Mode::kFlight) {
      const T deflection = p_.l0 - Chord(z).l;
      energy += 0.5 * p_.k * deflection * deflection;
    }
    return energy;
  }
  double Flexure(Mode, const T*) const { return 0.0; }
  const SpeedController<T>& controller() const { return controller_; }

 private:
  struct ChordState {
    T u, l, force;  // contact lead [m], chord length [m], chord force [N]
  };
  ChordState Chord(const T* z) const {
    using std::sqrt;
    const T u = z[kContact] - z[kX];
    const T l = sqrt(u * u + z[kY] * z[kY]);
    const T rate = (z[kY] * z[kVy] - u * z[kVx]) / l;
    return {u, l, p_.k * (p_.l0 - l) - p_.d * rate};
  }
  Vector2<T> HipForce(const ChordState& c, const T* z) const {
    const T chord = c.force / c.l;
    const T normal = controller_.Torque(z[kVx]) / (c.l * c.l);
    return {normal * z[kY] - chord * c.u, chord * z[kY] + normal * c.u};
  }
  T TouchdownHeight(const T* z) const {
    using std::cos;
    return p_.l0 * cos(effects_.TouchdownAngle(z[kVx], p_.theta_td));
  }

  Parameters<T> p_;
  ActiveEffects<T> effects_;
  LiftoffRule liftoff_;
  bool has_body_force_;
  SpeedController<T> controller_;
  T y_min_;
};

}  // namespace hoplab
