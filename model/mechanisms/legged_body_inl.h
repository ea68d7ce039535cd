#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/mechanisms/heavy_leg_inl.h"
#include "model/mechanisms/legged_body.h"
#include "model/mechanisms/legged_body_events_inl.h"
#include "model/mechanisms/legged_body_forces_inl.h"

namespace hoplab {

template <class T, class LegT>
LeggedBody<T, LegT>::LeggedBody(const MechanismSetup<T>& setup)
    : p_(ParametersOf(setup)),
      effects_(setup.effects),
      liftoff_(setup.liftoff),
      lagged_(Value(p_.torque_lag) >= kShortestLag),
      has_body_force_(effects_.HasBodyForce() || setup.inputs.HasForce()),
      has_chord_force_(effects_.HasChordForce()),
      has_hip_torque_(effects_.HasHipTorque()),
      has_hip_formula_(effects_.HasHipFormula()),
      has_joint_torque_(effects_.HasJointTorque()),
      is_driven_(has_hip_torque_ || has_joint_torque_ || lagged_ || !IsZero(p_.kp) ||
                 setup.inputs.Has(InputKind::kHipTorque)),
      has_quick_lag_(!lagged_ && !IsZero(p_.torque_lag)),
      // The touch-down angle moves in flight if it depends on a speed that does.
      flies_freely_(!has_body_force_ && !setup.inputs.Has(InputKind::kLegAngle) &&
                    !effects_.TouchdownAngleFalls() &&
                    (IsZero(p_.slope) || !effects_.HasTouchdownAngle())),
      extended_(p_.law_terms.active),
      bends_by_load_(BendsByLoad(setup)),
      is_bar_(setup.law == Law::kStraightLeg),
      has_leg_mass_(p_.law_terms.leg_mass_active),
      has_foot_friction_(p_.law_terms.foot_friction_active),
      foot_has_inertia_(has_leg_mass_ && has_foot_friction_ && !p_.on_guide &&
                        Value(p_.law_terms.foot_friction) > kLeastFriction &&
                        Value(p_.law_terms.leg_mass) > kLeastFootShare * Value(p_.m)),
      damps_along_arc_(DampsAlongArc(setup)),
      may_pull_(p_.law_terms.torque_active),
      torque_lift_(p_.reading.torque_sign == ThesisReading::TorqueSign::kPrinted ? -1.0 : 1.0),
      inertia_(p_),
      leg_(setup.law, p_),
      controller_(p_),
      y_min_(std::isnan(p_.fall_height) ? leg_->LowestHip() : T(p_.fall_height)),
      start_angle_(std::isnan(p_.start_angle) ? p_.theta_td : T(p_.start_angle)),
      inputs_(setup.inputs),
      angles_(setup.touchdown_angles),
      driven_(!setup.inputs.empty()) {}

// A leg that knows its curvature damps along its arc, unless it swings with a mass at its toe.
template <class T, class LegT>
bool LeggedBody<T, LegT>::DampsAlongArc(const MechanismSetup<T>& setup) {
  return setup.law == Law::kElastica && setup.parameters.law_terms.material_damping_active &&
         IsZero(setup.parameters.m_toe);
}
// M94.
template <class T, class LegT>
bool LeggedBody<T, LegT>::BendsByLoad(const MechanismSetup<T>& setup) {
  return setup.law == Law::kElastica && setup.effects.HasTorqueOfLoad() &&
         IsZero(setup.parameters.m_toe);
}
// M120: `elastica` knows what a torque at the hip does to its arc, unless it is told another share.
template <class T, class LegT>
bool LeggedBody<T, LegT>::BendsByItsLaw(const MechanismSetup<T>& setup) {
  const Parameters<T>& p = setup.parameters;
  const bool is_driven = !IsZero(p.kp) || setup.inputs.Has(InputKind::kHipTorque) ||
                         !IsZero(p.torque_lag) || setup.effects.HasHipTorque();
  return setup.law == Law::kElastica && is_driven && !p.law_terms.torque_active && IsZero(p.m_toe);
}
template <class T, class LegT>
Parameters<T> LeggedBody<T, LegT>::ParametersOf(const MechanismSetup<T>& setup) {
  Parameters<T> p = setup.parameters;
  if (BendsByItsLaw(setup)) {
    p.law_terms.active = p.law_terms.torque_active = true;
    p.law_terms.torque_bending = T(1.0);
  }
  if (BendsByLoad(setup))
    p.law_terms.active = p.law_terms.slopes_active = p.law_terms.torque_active = true;
  if (DampsAlongArc(setup)) p.law_terms.active = p.law_terms.slopes_active = true;
  return p;
}

template <class T, class LegT>
void LeggedBody<T, LegT>::SaveDiscreteState(DiscreteState& to) const {
  leg_->SaveDiscreteState(to);
  to.Put(controller_.saturation());
  to.Put(landings_);
  to.Put(sinks_ ? 1.0 : 0.0);
  to.Put(slides_);
  to.Put(is_lifted_ ? 1.0 : 0.0);
  if (driven_) inputs_.Save(to);
  effects_.SaveCorners(to);
}
template <class T, class LegT>
void LeggedBody<T, LegT>::LoadDiscreteState(DiscreteState& from) {
  leg_->LoadDiscreteState(from);
  controller_.set_saturation(static_cast<int>(from.Take()));
  landings_ = static_cast<int>(from.Take());
  sinks_ = from.Take() > 0.5;
  slides_ = from.Take();
  is_lifted_ = from.Take() > 0.5;
  if (driven_) inputs_.Load(from);
  effects_.LoadCorners(from);
}

// ---- corners of formulas -------------------------------------------------------------------

template <class T, class LegT>
template <class Act>
void LeggedBody<T, LegT>::WithMotionsAt(Mode mode, const T& t, const T* z, const Act& act) const {
  if (mode == Mode::kFlight) return WithMotions(mode, t, z, nullptr, nullptr, act);
  const LegLoad<T> load = Load(mode, t, z);
  const ChordMotion<T> chord = ChordMotionAt(load, t);
  const HipMotion<T> hip = HipMotionAt(mode, MotorTorque(t, z), load, t, z);
  WithMotions(mode, t, z, &chord, &hip, act);
}
template <class T, class LegT>
void LeggedBody<T, LegT>::Seat(Mode mode, const T& t, const T* z) {
  if (effects_.corner_count() == 0) return;
  WithMotionsAt(mode, t, z, [&](const Motions<T>& m) { effects_.SeatCorners(m); });
}

template <class T, class LegT>
std::optional<T> LeggedBody<T, LegT>::PassKnot(Mode mode, double t, T* z) {
  const bool flight = mode == Mode::kFlight;
  const std::optional<InputKind> due = inputs_.Due(flight, t);
  if (due == InputKind::kHipTorque && has_quick_lag_) {
    // M52: a motor that lags by t_lag gives t_lag times the jump less than its command, at once.
    const T now = MotorTorque(T(t), z);
    const auto force = [&](const T& motor) {
      const LegLoad<T> load =
          may_pull_ ? leg_->extended().Load(mode, z, BentBy(motor, T(t))) : Load(mode, T(t), z);
      return HipForce(load, motor, T(t));
    };
    const Vector2<T> before = force(now);
    const Vector2<T> after = force(now + inputs_.of(InputKind::kHipTorque).NextJump());
    if (!inertia_.on_guide) z[kVx] -= p_.torque_lag * (after.x - before.x) / inertia_.mx;
    z[kVy] -= p_.torque_lag * (after.y - before.y) / inertia_.my;
    Seat(mode, T(t), z);
  }
  return inputs_.Pass(flight, t);
}

template <class T, class LegT>
void LeggedBody<T, LegT>::Derivative(Mode mode, const T& t, const T* z, T* dz) const {
  T fx(0.0), fy(0.0);
  T contact_rate(0.0);
  LegLoad<T> load;
  if (mode != Mode::kFlight) {
    load = Load(mode, t, z);
    const Vector2<T> force = HipForce(load, HipTorque(mode, load, t, z), t);
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
  dz[kVx] = inertia_.on_guide ? T(0.0) : T(fx / inertia_.mx + inertia_.gravity_x);  // M13
  dz[kVy] = fy / inertia_.my + inertia_.gravity_y;                                  // M14
  dz[kContact] = contact_rate;
  if (foot_has_inertia_) dz[FootSpeed()] = T(0.0);
  if (has_leg_mass_ && mode != Mode::kFlight) {
    if (slides_ != 0.0) {
      SlidingAcceleration(load, {fx, fy}, mode, t, z, dz);
    } else {
      const Vector2<T> rate = HeavyAcceleration(load, {fx, fy}, z);
      dz[kVx] = rate.x;
      dz[kVy] = rate.y;
    }
  }
  if (!lagged_) return;
  dz[kMotorTorque] = T(0.0);
  if (mode != Mode::kFlight)
    dz[kMotorTorque] = (CommandedTorque(t, z) - z[kMotorTorque]) / p_.torque_lag;
}

template <class T, class LegT>
BallisticFlight<T> LeggedBody<T, LegT>::Ballistic(const T* z) const {
  const T touchdown = TouchdownHeight(T(0.0), z);
  BallisticFlight<T> flight{inertia_.gravity_x, inertia_.gravity_y, touchdown};
  if (FallsBelow(touchdown)) flight.floor = Value(y_min_);
  return flight;
}
template <class T, class LegT>
std::optional<BallisticFlight<T>> LeggedBody<T, LegT>::FreeFlight() const {
  return BallisticFlight<T>{inertia_.gravity_x, inertia_.gravity_y};
}

/// First step of a mode [s]: in stance a tenth of a radian of the undamped oscillation, and no
/// more than a lag of the torque.
template <class T, class LegT>
double LeggedBody<T, LegT>::FirstStep(Mode mode, const T* z) const {
  if (mode == Mode::kFlight) return 0.01;
  const double step = 0.1 * leg_->TimeScale(Load(mode, T(0.0), z));
  return lagged_ ? std::min(step, Value(p_.torque_lag)) : step;
}

template <class T, class LegT>
Observation<T> LeggedBody<T, LegT>::Observe(Mode mode, const T& t, const T* z) const {
  Observation<T> seen = this->Unseen();
  seen[Channel::kBodyX] = z[kX];
  seen[Channel::kBodyY] = z[kY];
  seen[Channel::kBodyVx] = z[kVx];
  seen[Channel::kBodyVy] = z[kVy];
  if (mode == Mode::kFlight) {
    const T theta = TouchdownAngle(t, z);
    seen[Channel::kContactX] = z[kX] + Lead(theta);
    seen[Channel::kContactY] = T(0.0);
    seen[Channel::kLegAngle] = theta;
    seen[Channel::kLegLength] = leg_->ShownLength(theta);
    for (Channel c :
         {Channel::kGroundForceX, Channel::kGroundForceY, Channel::kHipTorque, Channel::kContact})
      seen[c] = T(0.0);
    if (has_leg_mass_) AddSwing(t, seen);
    return seen;
  }
  const LegLoad<T> load = Load(mode, t, z);
  const T torque = HipTorque(mode, load, t, z);
  const Vector2<T> force = HipForce(load, torque, t);
  seen[Channel::kLegAngle] = leg_->ShownAngle(mode, load);
  seen[Channel::kLegLength] = load.l;
  seen[Channel::kGroundForceX] = is_lifted_ ? T(0.0) : force.x;
  seen[Channel::kGroundForceY] = is_lifted_ ? T(0.0) : force.y;
  seen[Channel::kHipTorque] = torque;
  seen[Channel::kContact] = T(1.0);
  seen[Channel::kContactX] = z[kX] + load.u;
  seen[Channel::kContactY] = z[kY] - load.y;
  seen[Channel::kContactArc] = leg_->ShownArc(load);
  return seen;
}

template <class T, class LegT>
T LeggedBody<T, LegT>::Energy(Mode mode, const T* z) const {
  T energy = inertia_.Energy(z);
  const auto weigh = [&](const LegInertia<T>& leg) {
    energy += p_.law_terms.leg_mass / p_.m *
              (inertia_.weight_along * leg.x.value + inertia_.weight_down * leg.y.value);
  };
  if (mode == Mode::kFlight) {
    if (has_leg_mass_) weigh(InertiaOfLeg(Placed(TouchdownAngle(z))));
    return energy;
  }
  const LegLoad<T> load = Load(mode, T(0.0), z);
  if (has_leg_mass_) {
    energy += KineticEnergyOfLeg(load, z);
    weigh(InertiaOfLeg(load));
  }
  if (extended_)
    return energy + leg_->extended().StrainEnergy(mode, load, Conditions(mode, T(0.0), z, z));
  return energy + leg_->StrainEnergy(load);
}

template <class T, class LegT>
double LeggedBody<T, LegT>::DeflectionRatio(Mode mode, const double* values) const {
  if (mode == Mode::kFlight || !leg_->IsExpansion()) return 0.0;
  T z[kMostLegStates];
  for (int i = 0; i < size(); ++i) z[i] = T(values[i]);
  return leg_->DeflectionRatio(Load(mode, T(0.0), z));
}

template <class T, class LegT>
LegLoad<T> LeggedBody<T, LegT>::Load(Mode mode, const T& t, const T* z) const {
  if (slides_ != 0.0) {  // the leg feels the hip move over its foot
    T over[kMostLegStates];
    std::copy_n(z, size(), over);
    over[kVx] -= z[FootSpeed()];
    LegLoad<T> load = extended_ ? leg_->extended().Load(mode, over, Conditions(mode, t, z, over))
                                : leg_->Load(mode, over);
    load.contact_rate += z[FootSpeed()];
    return load;
  }
  if (extended_) return leg_->extended().Load(mode, z, Conditions(mode, t, z, z));
  return leg_->Load(mode, z);
}

}  // namespace hoplab
