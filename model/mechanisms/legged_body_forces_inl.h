#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/mechanisms/legged_body.h"

// What acts on a legged body: forces along the chord, torques of the hip, the angle it is told.

namespace hoplab {

template <class T, class LegT>
ChordMotion<T> LeggedBody<T, LegT>::ChordMotionAt(const LegLoad<T>& load, const T& t) const {
  const T rest = leg_->RestChord(load);
  return {load.elastic_force, leg_->Stiffness(load), load.damping_rate, T((rest - load.l) / rest),
          SinceFirstRow(t)};
}

template <class T, class LegT>
T LeggedBody<T, LegT>::ChordForce(const LegLoad<T>& load, const T& t) const {
  T force = load.elastic_force - p_.d * load.damping_rate;  // M6, M12
  if (damps_along_arc_)
    force += (load.y * load.viscous_y - load.u * load.viscous_x) / load.l;
  else if (p_.law_terms.material_damping_active)
    force -= p_.law_terms.material_damping * leg_->Stiffness(load) * load.damping_rate;
  if (has_chord_force_) force += effects_.ChordForce(ChordMotionAt(load, t));
  return force;
}

template <class T, class LegT>
T LeggedBody<T, LegT>::TouchdownAngle(const T& t, const T* z) const {
  T commanded = landings_ == 0 ? start_angle_ : p_.theta_td;
  if (inputs_.Has(InputKind::kLegAngle)) {
    commanded = inputs_.At(InputKind::kLegAngle, t);
    commanded -= 2.0 * std::numbers::pi * std::round(Value(commanded) / (2.0 * std::numbers::pi));
  } else if (!angles_.empty()) {
    commanded = angles_[std::min(static_cast<std::size_t>(landings_), angles_.size() - 1)];
  }
  return effects_.TouchdownAngle(PlacementAt(z), commanded) - p_.slope;
}
template <class T, class LegT>
T LeggedBody<T, LegT>::TouchdownHeight(const T& t, const T* z) const {
  return effects_.ContactHeight(leg_->TouchdownHeight(TouchdownAngle(t, z)));
}
// M51: the angle a leg touches down at. One whose command jumps into the ground swings there at
// once, and lands at the angle on its way at which it meets it.
template <class T, class LegT>
T LeggedBody<T, LegT>::SweptAngle(const T& t, const T* z) const {
  const T commanded = TouchdownAngle(t, z);
  const InputSignal<T>& angle = inputs_.of(InputKind::kLegAngle);
  const double size = leg_->Size();
  const auto above = [&](double theta) {
    return Value(z[kY]) - Value(effects_.ContactHeight(leg_->TouchdownHeight(T(theta))));
  };
  if (!angle.present() || !angle.held() || above(Value(commanded)) > -1e-9 * size) return commanded;
  double down = Value(commanded), up = down - Value(angle.At(t)) + Value(angle.Before());
  if (!(above(up) > 0.0)) return commanded;
  constexpr int kRounds = 100;
  for (int i = 0; i < kRounds; ++i) {
    const double middle = 0.5 * (up + down);
    (above(middle) > 0.0 ? up : down) = middle;
  }
  // Its derivative: the height there must stay the hip's.
  const T theta(0.5 * (up + down));
  const double step = 1e-6;
  const double slope = (above(Value(theta) + step) - above(Value(theta) - step)) / (2.0 * step);
  const T off = z[kY] - effects_.ContactHeight(leg_->TouchdownHeight(theta));
  return theta - (off - Value(off)) / slope;
}
template <class T, class LegT>
T LeggedBody<T, LegT>::Lead(const T& theta) const {
  using std::sin;
  return leg_->ShownLength(theta) * sin(leg_->ChordAngle(theta));
}
template <class T, class LegT>
Vector2<T> LeggedBody<T, LegT>::BodyForce(Mode mode, const T& t, const T* z) const {
  Vector2<T> force = effects_.BodyForce(BodyMotionAt(mode, t, z));
  AddInputForce(inputs_, p_.slope, t, force);
  return force;
}

// The torque that bends the leg, `over` being the state over its foot. One that asks how the leg
// turns is given the leg that it does not bend, M94.
template <class T, class LegT>
LegConditions<T> LeggedBody<T, LegT>::Conditions(Mode mode, const T& t, const T* z,
                                                 const T* over) const {
  const T motor = MotorTorque(t, z);
  T torque = WithUnloadedEffects(motor, t, z);
  if (has_quick_lag_ && may_pull_) {
    const LegLoad<T> load = leg_->extended().Load(mode, over, BentBy(torque, t));
    torque = WithUnloadedEffects(QuickLagged(mode, motor, load, t, z), t, z);
  }
  const LegConditions<T> driven = BentBy(torque, t);
  if (!bends_by_load_) return driven;
  const LegLoad<T> load = leg_->extended().Load(mode, over, driven);
  return {t, driven.torque + WithTorqueEffects(mode, motor, load, t, z) -
                 WithUnloadedEffects(motor, t, z)};
}
template <class T, class LegT>
LegConditions<T> LeggedBody<T, LegT>::BentBy(const T& torque, const T& t) const {
  return {t, T(p_.law_terms.torque_bending * torque)};
}
// The motor's torque with what effects add that do not ask how the leg is loaded.
template <class T, class LegT>
T LeggedBody<T, LegT>::WithUnloadedEffects(T torque, const T& t, const T* z) const {
  if (has_hip_torque_) effects_.AddHipTorque({torque, SinceFirstRow(t), z[kVx]}, torque, false);
  return torque;
}
// What the motor gives: its command, or with a lag long enough to integrate a state.
template <class T, class LegT>
T LeggedBody<T, LegT>::MotorTorque(const T& t, const T* z) const {
  return lagged_ ? z[kMotorTorque] : CommandedTorque(t, z);
}
// What the motor is told: by the controller, or as logged (M52).
template <class T, class LegT>
T LeggedBody<T, LegT>::CommandedTorque(const T& t, const T* z) const {
  return inputs_.Has(InputKind::kHipTorque) ? inputs_.At(InputKind::kHipTorque, t)
                                            : controller_.Torque(z[kVx]);
}
// Torque on the hip: the motor's, and what effects add.
template <class T, class LegT>
T LeggedBody<T, LegT>::HipTorque(Mode mode, const LegLoad<T>& load, const T& t, const T* z) const {
  if (!is_driven_) return T(0.0);
  const T motor = MotorTorque(t, z);
  return WithTorqueEffects(mode, has_quick_lag_ ? QuickLagged(mode, motor, load, t, z) : motor,
                           load, t, z);
}
// What a motor gives whose lag is too short to integrate, to its first order:
// T_cmd - t_lag dT_cmd/dt.
template <class T, class LegT>
T LeggedBody<T, LegT>::QuickLagged(Mode mode, const T& motor, const LegLoad<T>& load, const T& t,
                                   const T* z) const {
  T fx = HipForce(load, WithTorqueEffects(mode, motor, load, t, z), t).x;
  if (has_body_force_) fx += BodyForce(mode, t, z).x;
  const T rate = inputs_.Has(InputKind::kHipTorque)
                     ? inputs_.of(InputKind::kHipTorque).Rate()
                     : controller_.TorqueRate(fx / inertia_.mx + inertia_.gravity_x);
  return motor - p_.torque_lag * rate;
}
template <class T, class LegT>
HipMotion<T> LeggedBody<T, LegT>::HipMotionAt(Mode mode, const T& torque, const LegLoad<T>& load,
                                              const T& t, const T* z) const {
  HipMotion<T> hip{torque, SinceFirstRow(t), z[kVx], load.u / load.l};
  if (has_hip_formula_) {
    const T rest = leg_->RestChord(load);
    hip.angle = leg_->ShownAngle(mode, load);
    hip.rate = load.angle_rate;
    hip.compression = (rest - load.l) / rest;
  }
  return hip;
}
template <class T, class LegT>
T LeggedBody<T, LegT>::WithTorqueEffects(Mode mode, T torque, const LegLoad<T>& load, const T& t,
                                         const T* z) const {
  if (has_hip_torque_) effects_.AddHipTorque(HipMotionAt(mode, torque, load, t, z), torque);
  if (has_joint_torque_) torque += effects_.JointTorque({load.angle_rate});
  return torque;
}
// F e + (T/l) n, the bracket of M13 and M14 (M37); by reaction, the ground's force on the leg.
template <class T, class LegT>
Vector2<T> LeggedBody<T, LegT>::HipForce(const LegLoad<T>& load, const T& torque,
                                         const T& t) const {
  const T chord = ChordForce(load, t) / load.l;
  Vector2<T> force{-chord * load.u, chord * load.y};
  if (is_driven_) {
    const T normal = torque / (load.l * load.l);
    force = {normal * load.y - chord * load.u, chord * load.y + torque_lift_ * normal * load.u};
  }
  if (damps_along_arc_) {  // the part along the chord is in it
    const T across = (load.y * load.viscous_x + load.u * load.viscous_y) / (load.l * load.l);
    force.x += across * load.y;
    force.y += across * load.u;
  }
  return force;
}

}  // namespace hoplab
