#pragma once

#include <array>

#include "model/mechanisms/robot_legs_inl.h"

// How a robot whose legs have mass moves: Lagrange's equations of body, motors and feet, leg by leg
// eliminated, and what the ground bears (M83, M92).

namespace hoplab {

/// Right side of the equations of motion, or momenta: of (x, y, pitch), the motors, the feet.
template <class T>
struct Robot<T>::Sides {
  T x{0.0}, y{0.0}, pitch{0.0};
  std::array<T, kMaxLegs> motor, foot;

  // What acts on a leg's motion, at its hip.
  void Add(int i, const Hip& hip, const LegMotion<T>& load) {
    x += load[0];
    y += load[1];
    pitch += hip.x * load[1] - hip.y * load[0] + load[2];
    motor[i] += load[2];
    foot[i] += load[3];
  }
  void Clear() {
    x = y = pitch = T(0.0);
    motor.fill(T(0.0));
    foot.fill(T(0.0));
  }
};

/// Rows of x, y, pitch and of the motors; the last column is the right side.
template <class T>
struct Robot<T>::Rows {
  T a[3][4];
  T motor[kMaxLegs][4], over[kMaxLegs];
};

// A leg's foot and motor are eliminated, each from its own row.
template <class T>
void Robot<T>::AddLegRows(int i, const LegPlace& at, const LegInertia& leg, const Sides& sides,
                          Rows& rows) const {
  const bool locked = robot_.control == MotorControl::kLocked;
  const T zero(0.0);
  const Hip& p = at.hip;
  const LegMatrix<T>& k = leg.mass;
  // Of the hip along and up and the base; the last column is the right side.
  T e[3][4] = {{k.xx, k.xy, k.xb, zero}, {k.xy, k.yy, k.yb, zero}, {k.xb, k.yb, k.bb, zero}};
  if (leg.foot) {
    const LegMotion<T>& row = leg.row;
    const T of = 1.0 / row[3];
    const T share[3] = {k.xf * of, k.yf * of, k.bf * of};
    for (int j = 0; j < 3; ++j) {
      for (int l = 0; l < 3; ++l) e[j][l] -= share[j] * row[l];
      e[j][3] = -share[j] * sides.foot[i];
    }
  }
  const T own = locked ? T(1.0) : T(1.0 / (hub_[i] + e[2][2]));
  rows.over[i] = own;
  // The pitch moves hip and base.
  for (int j = 0; j < 3; ++j) {
    const T base = e[j][2];
    e[j][2] += p.x * e[j][1] - p.y * e[j][0];
    const T share = locked ? zero : T(base * own);
    if (j < 2) {
      for (int l = 0; l < 4; ++l) rows.a[j][l] += e[j][l];
      for (int l = 0; l < 4; ++l) rows.a[2][l] += (j == 0 ? T(-p.y) : p.x) * e[j][l];
    } else {
      for (int l = 0; l < 4; ++l) rows.a[2][l] += e[2][l];
    }
    rows.motor[i][j] = share;
  }
  if (locked) return;
  // The motor's row, and what it takes from the others.
  const T turn = p.x * rows.motor[i][1] - p.y * rows.motor[i][0] + rows.motor[i][2];
  const T right = e[2][3] + sides.motor[i];
  const T share_x = rows.motor[i][0], share_y = rows.motor[i][1];
  const T row[4] = {e[2][0], e[2][1], e[2][2], right};
  for (int l = 0; l < 4; ++l) {
    rows.a[0][l] -= share_x * row[l];
    rows.a[1][l] -= share_y * row[l];
    rows.a[2][l] -= turn * row[l];
    rows.motor[i][l] = row[l];
  }
}

// Three equations are left, of the reference point and the pitch. Gives what the sides do to the
// rates, in the places of dz.
template <class T>
void Robot<T>::SolveMotion(const Vector2<T>& com, const std::array<LegPlace, kMaxLegs>& at,
                           const std::array<LegInertia, kMaxLegs>& legs, const Sides& sides,
                           T* dz) const {
  const bool locked = robot_.control == MotorControl::kLocked;
  const T& m = p_.m;
  const T zero(0.0);
  Rows rows{{{m, zero, -m * com.y, sides.x},
             {zero, m, m * com.x, sides.y},
             {-m * com.y, m * com.x, robot_.pitch_inertia + m * (com.x * com.x + com.y * com.y),
              sides.pitch}},
            {},
            {}};
  for (int i = 0; i < legs_; ++i) AddLegRows(i, at[i], legs[i], sides, rows);
  for (int j = 0; j < 2; ++j) {
    const T of = 1.0 / rows.a[j][j];
    for (int k = j + 1; k < 3; ++k) {
      const T share = rows.a[k][j] * of;
      for (int l = j + 1; l < 4; ++l) rows.a[k][l] -= share * rows.a[j][l];
    }
  }
  const T spin = rows.a[2][3] / rows.a[2][2],
          ay = (rows.a[1][3] - rows.a[1][2] * spin) / rows.a[1][1],
          ax = (rows.a[0][3] - rows.a[0][1] * ay - rows.a[0][2] * spin) / rows.a[0][0];
  dz[kVx] = ax;
  dz[kVy] = ay;
  dz[Pitch() + 1] = spin;
  for (int i = 0; i < legs_; ++i) {
    const T turn = locked ? zero
                          : T((rows.motor[i][3] - rows.motor[i][0] * ax - rows.motor[i][1] * ay -
                               rows.motor[i][2] * spin) *
                              rows.over[i]);
    dz[Rate(i)] = turn;
    if (!foot_has_inertia_) continue;
    const LegMotion<T>& row = legs[i].row;
    const Hip& p = at[i].hip;
    dz[FootSpeed(i)] = legs[i].foot ? T((sides.foot[i] - row[0] * (ax - spin * p.y) -
                                         row[1] * (ay + spin * p.x) - row[2] * (spin + turn)) /
                                        row[3])
                                    : zero;
  }
}

// What leg i's hip, base and foot do under the rates (or accelerations, but for those of M72).
template <class T>
LegMotion<T> Robot<T>::MotionUnder(int i, const Hip& hip, const T* rates) const {
  const T& turn = rates[Pitch() + 1];
  return {rates[kVx] - turn * hip.y, rates[kVy] + turn * hip.x, turn + rates[Rate(i)],
          foot_has_inertia_ ? rates[FootSpeed(i)] : T(0.0)};
}

// M92: the ground's force on a foot.
template <class T>
Vector2<T> Robot<T>::GroundForce(const Frame& frame, int i, const Push& push, const T* z,
                                 const T* dz) const {
  const LegPlace at = LegOf(frame, i, z);
  const LegInertia leg = InertiaOf(i, at);
  const T turn2 = z[Pitch() + 1] * z[Pitch() + 1];
  LegMotion<T> a = MotionUnder(i, at.hip, dz);
  a[0] -= turn2 * at.hip.x;
  a[1] -= turn2 * at.hip.y;
  const LegMotion<T> carried = leg.mass * a;
  const Vector2<T> born = BornBy(at, leg, MotionOf(i, at.hip, z));
  const ClampedLoad<T>& load = push.load[i];
  return {load.fx + load.damped_x + Dot(leg.along, a) - carried[0] + born.x,
          load.fy + load.damped_y + Dot(leg.up, a) - carried[1] + born.y};
}

template <class T>
void Robot<T>::GroundForces(const Frame& frame, const T& t, const T* z,
                            std::array<ClampedLoad<T>, kMaxLegs>& loads,
                            std::array<Vector2<T>, kMaxLegs>& ground) const {
  Push push = PushOf(frame, t, z);
  std::array<T, kMaxStates> rates;
  Accelerate(frame, push, z, rates.data());
  if (lags_shortly_) LagShortly(frame, push, z, rates.data());
  loads = push.load;
  for (int i = 0; i < legs_; ++i)
    if (IsDown(leg_[i])) ground[i] = GroundForce(frame, i, push, z, rates.data());
}

// M83 with the matrices of M89.
template <class T>
void Robot<T>::AccelerateWithLegMass(const Frame& frame, const Push& push, const T* z,
                                     T* dz) const {
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  const T& turn = z[Pitch() + 1];
  const T turn2 = turn * turn;
  std::array<LegPlace, kMaxLegs> at;
  std::array<LegInertia, kMaxLegs> legs;
  Sides sides;
  sides.Clear();
  const T fx = push.force_x + p_.m * gravity_x_, fy = push.force_y + p_.m * gravity_y_;
  sides.x = fx + p_.m * turn2 * com.x;
  sides.y = fy + p_.m * turn2 * com.y;
  sides.pitch = push.moment + com.x * fy - com.y * fx;
  for (int i = 0; i < legs_; ++i) {
    at[i] = LegOf(frame, i, z);
    legs[i] = InertiaOf(i, at[i]);
    LegMotion<T> load = LoadOf(i, at[i], legs[i], z);
    // The hip is drawn towards the reference point as it turns about it.
    const LegMotion<T> drawn{turn2 * at[i].hip.x, turn2 * at[i].hip.y, T(0.0), T(0.0)};
    const LegMotion<T> held = legs[i].mass * drawn;
    for (int k = 0; k < 3; ++k) load[k] += held[k];
    if (legs[i].foot) {
      const Vector2<T> born = BornBy(at[i], legs[i], MotionOf(i, at[i].hip, z));
      const ClampedLoad<T>& own = push.load[i];
      load[3] += Dot(legs[i].row, drawn) - own.fx - own.damped_x -
                 legs[i].lean * (own.fy + own.damped_y + born.y);
    }
    sides.Add(i, at[i].hip, load);
    sides.motor[i] += push.on_motor[i];
  }
  SolveMotion(com, at, legs, sides, dz);
}

}  // namespace hoplab
