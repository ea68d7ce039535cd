#pragma once

#include <numbers>

#include "model/mechanisms/inertia.h"
#include "model/mechanisms/robot_events_inl.h"

// What the robot's body, motors and legs do under their forces: M72, M73, and M82, M83 where the
// legs have mass.

namespace hoplab {

template <class T>
struct Robot<T>::Push {
  T force_x{0.0}, force_y{0.0};      // on the body [N]
  T moment{0.0};                     // on the body about its centre of mass [N m]
  std::array<T, kMaxLegs> on_motor;  // on each motor's angle [N m]
};

// M82: the leg as a rigid half ring that turns with its motor.
template <class T>
struct Robot<T>::LegPlace {
  Hip hip;
  T x, y;  // from the hip to its centre of mass [m]
};

template <class T>
typename Robot<T>::LegPlace Robot<T>::LegOf(const Frame& frame, int leg, const T* z) const {
  using std::cos;
  using std::sin;
  const Hip hip = HipOf(frame, leg, z);
  const T c = p_.r * cos(hip.angle), s = p_.r * sin(hip.angle);
  constexpr double kBehind = 2.0 / std::numbers::pi;
  return {hip, s - kBehind * c, -c - kBehind * s};
}

template <class T>
typename Robot<T>::Push Robot<T>::PushOf(const Frame& frame, const T& t, const T* z) const {
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  Push push;
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    T on_hip(0.0);
    if (IsDown(leg)) {
      const Hip hip = HipOf(frame, i, z);
      const Hip end = ClampOf(hip);
      const ClampedLoad<T> load = leg.arc.At(FootOf(leg), PlaceAt(leg, i, end, z));
      const T fx = load.fx + load.damped_x, fy = load.fy + load.damped_y;
      on_hip = load.moment + load.damped_moment + (end.x - hip.x) * fy - (end.y - hip.y) * fx;
      push.force_x += fx;
      push.force_y += fy;
      push.moment += (hip.x - com.x) * fy - (hip.y - com.y) * fx + on_hip;
    }
    push.on_motor[i] = robot_.control == MotorControl::kLocked
                           ? T(0.0)
                           : T(gain_[i] * (lags_ ? z[Given(i)] : Torque(i, t, z)) + on_hip);
  }
  if (has_body_force_) {
    const Vector2<T> air = effects_.BodyForce(
        {t + p_.time_origin, z[kX], z[kY], z[kVx], z[kVy], ModeNow() != Mode::kFlight});
    push.force_x += air.x;
    push.force_y += air.y;
  }
  return push;
}

// M72, M73.
template <class T>
void Robot<T>::Derivative(Mode, const T& t, const T* z, T* dz) const {
  const Frame frame(z[Pitch()] - p_.slope);
  Push push = PushOf(frame, t, z);
  const bool locked = robot_.control == MotorControl::kLocked;
  dz[kX] = z[kVx];
  dz[kY] = z[kVy];
  dz[Pitch()] = z[Pitch() + 1];
  for (int i = 0; i < legs_; ++i) {
    dz[Angle(i)] = locked ? T(0.0) : z[Rate(i)];
    dz[Contact(i)] = T(0.0);
    if (lags_) dz[Given(i)] = (Torque(i, t, z) - z[Given(i)]) / robot_.motor_lag;
  }
  Accelerate(frame, push, z, dz);
  if (lags_shortly_) LagShortly(frame, push, z, dz);
}

template <class T>
void Robot<T>::Accelerate(const Frame& frame, const Push& push, const T* z, T* dz) const {
  if (has_leg_mass_) return AccelerateWithLegMass(frame, push, z, dz);
  const bool locked = robot_.control == MotorControl::kLocked;
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  const T& turn = z[Pitch() + 1];
  const T spin = push.moment / robot_.pitch_inertia;
  dz[kVx] = push.force_x / p_.m + gravity_x_ + spin * com.y + turn * turn * com.x;
  dz[kVy] = push.force_y / p_.m + gravity_y_ - spin * com.x + turn * turn * com.y;
  dz[Pitch() + 1] = spin;
  for (int i = 0; i < legs_; ++i)
    dz[Rate(i)] = locked ? T(0.0) : T(push.on_motor[i] / robot_.rotor_inertia);
}

// M86: a lag too short to integrate, to its first order: what a motor gives is behind by the lag
// times the rate of what it is told.
template <class T>
void Robot<T>::LagShortly(const Frame& frame, Push& push, const T* z, T* dz) const {
  for (int i = 0; i < legs_; ++i) {
    if (leg_[i].limit != 0) continue;
    const T rate =
        robot_.control == MotorControl::kClock ? leg_[i].clock.Rate(leg_[i].piece) : T(0.0);
    const T told = robot_.motor_kp * (rate - z[Rate(i)]) - robot_.motor_kd * dz[Rate(i)];
    push.on_motor[i] -= gain_[i] * robot_.motor_lag * told;
  }
  Accelerate(frame, push, z, dz);
}

// M86: where what a motor is told jumps, the lag withholds the lag times the jump of its impulse.
// Accelerations are affine in the motors' torques: what one of 1 N m adds is the column of the
// inverse mass matrix.
template <class T>
void Robot<T>::MissJump(int leg, const T& jump, T* z) const {
  const Frame frame(z[Pitch()] - p_.slope);
  Push none, unit;
  none.on_motor.fill(T(0.0));
  unit.on_motor = none.on_motor;
  unit.on_motor[leg] = T(1.0);
  T without[kMaxStates], with[kMaxStates];
  Accelerate(frame, none, z, without);
  Accelerate(frame, unit, z, with);
  const T impulse = -gain_[leg] * robot_.motor_lag * jump;
  const auto add = [&](int rate) { z[rate] += impulse * (with[rate] - without[rate]); };
  add(kVx);
  add(kVy);
  add(Pitch() + 1);
  for (int i = 0; i < legs_; ++i) add(Rate(i));
}

// M83: the motors are eliminated, each from its own row; then three equations are left, of the
// reference point and the pitch.
template <class T>
void Robot<T>::AccelerateWithLegMass(const Frame& frame, const Push& push, const T* z,
                                     T* dz) const {
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  const T &m = robot_.leg_mass, &turn = z[Pitch() + 1];
  const T about_hip = 2.0 * m * p_.r * p_.r, turn2 = turn * turn;
  const T weight_x = p_.m * gravity_x_, weight_y = p_.m * gravity_y_;
  // Symmetric matrix and right side of (x, y, pitch).
  T xx = p_.m, xy(0.0), yy = p_.m, xt = -p_.m * com.y, yt = p_.m * com.x;
  T tt = robot_.pitch_inertia + p_.m * (com.x * com.x + com.y * com.y);
  T qx = push.force_x + weight_x + p_.m * turn2 * com.x;
  T qy = push.force_y + weight_y + p_.m * turn2 * com.y;
  T qt = push.moment + com.x * (push.force_y + weight_y) - com.y * (push.force_x + weight_x);
  // Of each motor: what couples it with (x, y, pitch), its inertia, its right side.
  std::array<T, kMaxLegs> bx, by, bt, own;
  const bool locked = robot_.control == MotorControl::kLocked;
  const T over = 1.0 / (robot_.rotor_inertia + about_hip);
  for (int i = 0; i < legs_; ++i) {
    const LegPlace leg = LegOf(frame, i, z);
    const Hip& p = leg.hip;
    const T rate2 = p.rate * p.rate, along = m * (p.x * leg.x + p.y * leg.y),
            across = m * (leg.x * p.y - leg.y * p.x),
            falls = m * (leg.x * gravity_y_ - leg.y * gravity_x_);
    xx += m;
    yy += m;
    xt -= m * (p.y + leg.y);
    yt += m * (p.x + leg.x);
    tt += m * (p.x * p.x + p.y * p.y) + 2.0 * along + about_hip;
    qx += m * (gravity_x_ + turn2 * p.x + rate2 * leg.x);
    qy += m * (gravity_y_ + turn2 * p.y + rate2 * leg.y);
    qt += falls + m * (p.x * gravity_y_ - p.y * gravity_x_) + across * (turn2 - rate2);
    if (locked) continue;
    bx[i] = -m * leg.y;
    by[i] = m * leg.x;
    bt[i] = along + about_hip;
    own[i] = push.on_motor[i] + falls + across * turn2;
    const T sx = bx[i] * over, sy = by[i] * over, st = bt[i] * over;
    xx -= sx * bx[i];
    xy -= sx * by[i];
    yy -= sy * by[i];
    xt -= sx * bt[i];
    yt -= sy * bt[i];
    tt -= st * bt[i];
    qx -= sx * own[i];
    qy -= sy * own[i];
    qt -= st * own[i];
  }
  // Cholesky without roots: x, y, then the pitch.
  const T l = xy / xx, u = xt / xx;
  const T dy = yy - l * xy, v = (yt - l * xt) / dy;
  const T ry = qy - l * qx;
  const T spin = (qt - u * qx - v * ry) / (tt - u * xt - v * (yt - l * xt));
  const T ay = ry / dy - v * spin, ax = (qx - xy * ay - xt * spin) / xx;
  dz[kVx] = ax;
  dz[kVy] = ay;
  dz[Pitch() + 1] = spin;
  for (int i = 0; i < legs_; ++i)
    dz[Rate(i)] = locked ? T(0.0) : T((own[i] - bx[i] * ax - by[i] * ay - bt[i] * spin) * over);
}

template <class T>
T Robot<T>::Energy(Mode, const T* z) const {
  const Frame frame(z[Pitch()] - p_.slope);
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  const T& turn = z[Pitch() + 1];
  const T centre[4] = {z[kX] + com.x, z[kY] + com.y, z[kVx] - turn * com.y, z[kVy] + turn * com.x};
  T energy = Inertia<T>(p_).Energy(centre) + 0.5 * robot_.pitch_inertia * turn * turn;
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    if (IsDown(leg))
      energy += leg.arc.StrainEnergy(FootOf(leg), PlaceOf(leg, i, HipOf(frame, i, z), z));
    if (has_leg_mass_) {
      const LegPlace at = LegOf(frame, i, z);
      const T vx = at.hip.vx - at.hip.rate * at.y, vy = at.hip.vy + at.hip.rate * at.x;
      const T about_centre = 2.0 * p_.r * p_.r - at.x * at.x - at.y * at.y;
      energy += robot_.leg_mass *
                (0.5 * (vx * vx + vy * vy + about_centre * at.hip.rate * at.hip.rate) -
                 gravity_x_ * (z[kX] + at.hip.x + at.x) - gravity_y_ * (z[kY] + at.hip.y + at.y));
    }
    if (robot_.control == MotorControl::kLocked) continue;
    energy += 0.5 * robot_.rotor_inertia * z[Rate(i)] * z[Rate(i)];
    if (robot_.control == MotorControl::kHeld) {
      const T off = robot_.angle[i] - z[Angle(i)];
      energy += 0.5 * robot_.motor_kp * off * off;
    }
  }
  return energy;
}

}  // namespace hoplab
