#pragma once

#include "model/mechanisms/inertia.h"
#include "model/mechanisms/robot_events_inl.h"

// What the robot's body, motors and legs do under their forces: M72, M73, and M82, M83 where the
// legs have mass.

namespace hoplab {

template <class T>
typename Robot<T>::Push& Robot<T>::PushOf(const Frame& frame, const T& t, const T* z) const {
  Push& push = push_;
  const Vector2<T>& com = push.com = frame.Turn(robot_.com_x, robot_.com_y);
  push.force_x = push.force_y = push.moment = T(0.0);
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    T on_hip(0.0);
    if (IsDown(leg)) {
      const Hip hip = HipOf(frame, i, z);
      std::optional<Hip> end;
      if (has_clamp_) end = ClampOf(hip);
      ClampedLoad<T>& load = push.load[i];
      leg.law.FillLoad(FootOf(leg), PlaceAt(leg, i, end ? *end : hip, z), load);
      const T fx = load.fx + load.damped_x, fy = load.fy + load.damped_y;
      on_hip = load.moment + load.damped_moment;
      if (end) on_hip += (end->x - hip.x) * fy - (end->y - hip.y) * fx;
      push.force_x += fx;
      push.force_y += fy;
      push.moment += (hip.x - com.x) * fy - (hip.y - com.y) * fx + on_hip;
    }
    T given(0.0);
    if (robot_.control != MotorControl::kLocked) {
      given = lags_ ? z[Given(i)] : Torque(i, t, z);
      if (has_gain_[i]) given *= gain_[i];
      if (has_bias_[i]) given += robot_.torque_bias[i];
    }
    if (leg.geared()) {
      const T passed = GearTorque(leg, i, z);
      push.on_rotor[i] = given - passed;
      given = passed;
    }
    if (rubs_[i] && !leg.is_held) given -= HipFriction(i, z);
    push.on_motor[i] = robot_.control == MotorControl::kLocked ? T(0.0) : T(given + on_hip);
  }
  if (has_body_force_) {
    const T& turn = z[Pitch() + 1];
    Vector2<T> air =
        effects_.BodyForce({t + p_.time_origin, z[kX] + com.x, z[kY] + com.y, z[kVx] - turn * com.y,
                            z[kVy] + turn * com.x, ModeNow() != Mode::kFlight});
    AddInputForce(inputs_, p_.slope, t, air);
    push.force_x += air.x;
    push.force_y += air.y;
  }
  return push;
}

// M72, M73.
template <class T>
void Robot<T>::Derivative(Mode, const T& t, const T* z, T* dz) const {
  AgeLegs(t);
  const Frame frame(z[Pitch()] - p_.slope);
  Push& push = PushOf(frame, t, z);
  const bool locked = robot_.control == MotorControl::kLocked;
  dz[kX] = z[kVx];
  dz[kY] = z[kVy];
  dz[Pitch()] = z[Pitch() + 1];
  for (int i = 0; i < legs_; ++i) {
    dz[Angle(i)] = locked ? T(0.0) : z[Rate(i)];
    dz[Contact(i)] = T(0.0);
    if (FootMoves(i)) dz[Contact(i)] = z[OwnRate(i)];
    if (creeps_ && IsDown(leg_[i]) && leg_[i].slides == 0.0)
      dz[Contact(i)] = -robot_.foot_slip * (push.load[i].fx + push.load[i].damped_x);
    if (follows_legs_) dz[Bent(i)] = Bends(i) ? z[OwnRate(i)] : T(0.0);
    if (lags_) dz[Given(i)] = (Torque(i, t, z) - z[Given(i)]) / robot_.motor_lag;
    if (leg_[i].geared()) dz[Twist(leg_[i])] = z[RotorRate(leg_[i])] - z[Rate(i)];
  }
  Accelerate(frame, push, z, dz);
  if (lags_shortly_) LagShortly(frame, push, z, dz);
}

template <class T>
void Robot<T>::Accelerate(const Frame& frame, const Push& push, const T* z, T* dz,
                          T* holding) const {
  for (int i = 0; i < legs_; ++i)
    if (leg_[i].geared())
      dz[RotorRate(leg_[i])] = push.on_rotor[i] / (robot_.rotor_inertia - hub_[i]);
  if (Value(robot_.leg_mass) != 0.0) return AccelerateWithLegMass(frame, push, z, dz, holding);
  const bool locked = robot_.control == MotorControl::kLocked;
  const Vector2<T>& com = push.com;
  const T& turn = z[Pitch() + 1];
  const T spin = push.moment / robot_.pitch_inertia;
  dz[kVx] = push.force_x / body_.mx + body_.gravity_x + spin * com.y + turn * turn * com.x;
  dz[kVy] = push.force_y / body_.my + body_.gravity_y - spin * com.x + turn * turn * com.y;
  dz[Pitch() + 1] = spin;
  for (int i = 0; i < legs_; ++i) {
    dz[Rate(i)] = locked || leg_[i].is_held ? T(0.0) : T(push.on_motor[i] / hub_[i]);
    if (holding) holding[i] = push.on_motor[i];
  }
  if (has_leg_mass_) AddFirstMass(frame, z, dz, holding);
}

// M86: a lag too short to integrate, to its first order: what a motor gives is behind by the lag
// times the rate of what it is told.
template <class T>
void Robot<T>::LagShortly(const Frame& frame, Push& push, const T* z, T* dz, T* holding) const {
  for (int i = 0; i < legs_; ++i) {
    if (leg_[i].limit != 0) continue;
    const T behind = gain_[i] * robot_.motor_lag * ToldRate(i, z, dz);
    (leg_[i].geared() ? push.on_rotor : push.on_motor)[i] -= behind;
  }
  Accelerate(frame, push, z, dz, holding);
}

// M86: where what a motor is told jumps, the lag withholds the lag times the jump of its impulse,
// at the state `at`. Accelerations are affine in the motors' torques: what one of 1 N m adds is the
// column of the inverse mass matrix.
template <class T>
void Robot<T>::MissJump(int leg, const T& jump, const T* at, T* z) const {
  const Frame frame(at[Pitch()] - p_.slope);
  Push none{};
  none.com = frame.Turn(robot_.com_x, robot_.com_y);
  Push unit = none;
  (leg_[leg].geared() ? unit.on_rotor : unit.on_motor)[leg] = T(1.0);
  T without[kMaxStates], with[kMaxStates];
  Accelerate(frame, none, at, without);
  Accelerate(frame, unit, at, with);
  const T impulse = -gain_[leg] * robot_.motor_lag * jump;
  const auto add = [&](int rate) { z[rate] += impulse * (with[rate] - without[rate]); };
  add(kVx);
  add(kVy);
  add(Pitch() + 1);
  for (int i = 0; i < legs_; ++i) {
    add(Rate(i));
    if (leg_[i].geared()) add(RotorRate(leg_[i]));
    if (follows_legs_) add(OwnRate(i));
  }
}

}  // namespace hoplab
