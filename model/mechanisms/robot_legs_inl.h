#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "model/mechanisms/robot_dynamics_inl.h"
#include "model/mechanisms/robot_leg_shape.h"

// The mass of a robot's legs: rigid in the air (M82), by their quasi-static shape on the ground
// (M89).

namespace hoplab {

/// Symmetric 4 x 4, upper triangle by rows.
template <class T>
struct LegMatrix {
  T xx, xy, xb, xf, yy, yb, yf, bb, bf, ff;

  LegMotion<T> operator*(const LegMotion<T>& u) const {
    return {xx * u[0] + xy * u[1] + xb * u[2] + xf * u[3],
            xy * u[0] + yy * u[1] + yb * u[2] + yf * u[3],
            xb * u[0] + yb * u[1] + bb * u[2] + bf * u[3],
            xf * u[0] + yf * u[1] + bf * u[2] + ff * u[3]};
  }
};

template <class T>
T Dot(const LegMotion<T>& a, const LegMotion<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// A leg's mass in the way it is on the ground or in the air now.
template <class T>
struct Robot<T>::LegInertia {
  bool foot = false;                 // whether its foot has a speed of its own
  T lean{0.0};                       // friction under that, against its way
  LegMotion<T> row;                  // the equation of that speed, friction included
  LegMatrix<T> mass, slope;          // its mass matrix [kg, m], and along beta
  LegMotion<T> along, up;            // momentum along and up by its motion [kg, m]
  LegMotion<T> along_turn, up_turn;  // their slopes along beta
  LegMotion<T> turn;                 // M90: by the rate of a rigid leg
};

// M82.
template <class T>
typename Robot<T>::LegInertia Robot<T>::RigidLeg(const LegPlace& at) const {
  const T &m = robot_.leg_mass, zero(0.0);
  const T x = m * at.x, y = m * at.y;
  LegInertia leg;
  leg.mass = {m, zero, -y, zero, m, x, zero, leg_[0].law.Inertia(m), zero, zero};
  leg.slope = {zero, zero, -x, zero, zero, -y, zero, zero, zero, zero};
  leg.along = {m, zero, -y, zero};
  leg.up = {zero, m, x, zero};
  leg.along_turn = {zero, zero, -x, zero};
  leg.up_turn = {zero, zero, -y, zero};
  leg.turn = {-y, x, leg.mass.bb, zero};
  return leg;
}

// M89, of a foot that holds.
template <class T>
typename Robot<T>::LegInertia Robot<T>::StandingLeg(int i, const LegPlace& at) const {
  using std::cos;
  using std::sin;
  using F = LegShape;
  const Leg& own = leg_[i];
  const T zero(0.0), &r = p_.r;
  const bool rolling = own.stance == Stance::kRolling;
  const T angle = at.hip.angle - 2.0 * kPi * own.turns;
  // On its toe the whole leg turns with its base.
  const F shape = LegShapeAt(rolling ? kPi - Value(angle) : kPi);
  const T off = rolling ? T(Value(angle) - angle) : zero;  // of Psi
  const auto of = [&](int k) { return T(shape.value[k] + shape.slope[k] * off); };
  const auto by = [&](int k) { return T(-shape.slope[k] - shape.bend[k] * off); };
  LegInertia leg;
  const T m = robot_.leg_mass, mr = m * r, mr2 = mr * r;
  if (rolling) {
    leg.mass = {m * of(F::kXX),  m * of(F::kXY), mr * of(F::kXB),  zero, m * of(F::kYY),
                mr * of(F::kYB), zero,           mr2 * of(F::kBB), zero, zero};
    leg.slope = {m * by(F::kXX),  m * by(F::kXY), mr * by(F::kXB),  zero, m * by(F::kYY),
                 mr * by(F::kYB), zero,           mr2 * by(F::kBB), zero, zero};
    leg.along = {m * of(F::kAlongX), m * of(F::kAlongY), mr * of(F::kAlongB), zero};
    leg.up = {m * of(F::kUpX), m * of(F::kUpY), mr * of(F::kUpB), zero};
    leg.along_turn = {m * by(F::kAlongX), m * by(F::kAlongY), mr * by(F::kAlongB), zero};
    leg.up_turn = {m * by(F::kUpX), m * by(F::kUpY), mr * by(F::kUpB), zero};
    leg.turn = {mr * of(F::kTurnX), mr * of(F::kTurnY), mr2 * of(F::kTurnB), zero};
    return leg;
  }
  const auto& v = shape.value;
  const T c = cos(angle), s = sin(angle);
  const T cc = c * c, ss = s * s, cs = c * s;
  LegMatrix<T>& k = leg.mass;
  k.xx = m * (cc * v[F::kXX] - 2.0 * cs * v[F::kXY] + ss * v[F::kYY]);
  k.yy = m * (ss * v[F::kXX] + 2.0 * cs * v[F::kXY] + cc * v[F::kYY]);
  k.xy = m * (cs * (v[F::kXX] - v[F::kYY]) + (cc - ss) * v[F::kXY]);
  k.xb = mr * (c * v[F::kXB] - s * v[F::kYB]);
  k.yb = mr * (s * v[F::kXB] + c * v[F::kYB]);
  k.bb = mr2 * v[F::kBB];
  k.xf = k.yf = k.bf = k.ff = zero;
  leg.slope = {-2.0 * k.xy, k.xx - k.yy, -k.yb, zero, 2.0 * k.xy, k.xb, zero, zero, zero, zero};
  const double even = 0.5 * (v[F::kAlongX] + v[F::kUpY]), odd = 0.5 * (v[F::kUpX] - v[F::kAlongY]),
               p = 0.5 * (v[F::kAlongX] - v[F::kUpY]), q = 0.5 * (v[F::kUpX] + v[F::kAlongY]);
  const T c2 = cc - ss, s2 = 2.0 * cs;
  const T pr = m * (p * c2 - q * s2), qr = m * (q * c2 + p * s2);
  const T along_b = mr * (c * v[F::kAlongB] - s * v[F::kUpB]),
          up_b = mr * (s * v[F::kAlongB] + c * v[F::kUpB]);
  leg.along = {m * even + pr, qr - m * odd, along_b, zero};
  leg.up = {qr + m * odd, m * even - pr, up_b, zero};
  leg.along_turn = {-2.0 * qr, 2.0 * pr, -up_b, zero};
  leg.up_turn = {2.0 * pr, 2.0 * qr, along_b, zero};
  leg.turn = {mr * (c * v[F::kTurnX] - s * v[F::kTurnY]),
              mr * (s * v[F::kTurnX] + c * v[F::kTurnY]), mr2 * v[F::kTurnB], zero};
  return leg;
}

// M92: a foot that slides moves the whole leg along with it; its friction goes with what the ground
// bears.
template <class T>
void Robot<T>::LetFootMove(const LegPlace& at, double slides, LegInertia& leg) const {
  const T &m = robot_.leg_mass, zero(0.0);
  const auto add = [](LegMatrix<T>& k, const LegMotion<T>& along, const T& mass) {
    k.xf = along[0] - k.xx;
    k.yf = along[1] - k.xy;
    k.bf = along[2] - k.xb;
    k.ff = mass - along[0] - k.xf;
  };
  add(leg.mass, leg.along, m);
  add(leg.slope, leg.along_turn, zero);
  leg.along[3] = m - leg.along[0];
  leg.up[3] = -leg.up[0];
  leg.along_turn[3] = -leg.along_turn[0];
  leg.up_turn[3] = -leg.up_turn[0];
  leg.turn[3] = -m * at.y - leg.turn[0];
  leg.foot = true;
  leg.lean = slides * robot_.friction;
  const LegMatrix<T>& k = leg.mass;
  leg.row = {k.xf + leg.lean * (leg.up[0] - k.xy), k.yf + leg.lean * (leg.up[1] - k.yy),
             k.bf + leg.lean * (leg.up[2] - k.yb), k.ff + leg.lean * (leg.up[3] - k.yf)};
}

template <class T>
typename Robot<T>::LegInertia Robot<T>::InertiaOf(int i, const LegPlace& at) const {
  if (!follows_feet_ || !IsDown(leg_[i])) return RigidLeg(at);
  LegInertia leg = StandingLeg(i, at);
  if (FootMoves(i)) LetFootMove(at, leg_[i].slides, leg);
  return leg;
}

template <class T>
LegMotion<T> Robot<T>::MotionOf(int i, const Hip& hip, const T* z) const {
  return {hip.vx, hip.vy, hip.rate, FootMoves(i) ? z[FootSpeed(i)] : T(0.0)};
}

// M89: where the hip is from where it would be over its foot with the leg unloaded.
template <class T>
Vector2<T> Robot<T>::PressOf(int i, const LegPlace& at, const T* z) const {
  using std::cos;
  using std::sin;
  const Leg& leg = leg_[i];
  const T angle = at.hip.angle - 2.0 * kPi * leg.turns;
  const T c = p_.r * cos(angle), s = p_.r * sin(angle);
  T lead = 2.0 * s, height = 2.0 * c;
  if (leg.stance == Stance::kRolling) {
    lead = s - p_.r * (leg.law.length() - angle);
    height = p_.r + c;
  }
  return {z[kX] + at.hip.x + lead - z[Contact(i)], z[kY] + at.hip.y - height};
}

// What does not come of the accelerations: the change of the mass matrix, and the weight.
template <class T>
LegMotion<T> Robot<T>::LoadOf(int i, const LegPlace& at, const LegInertia& leg, const T* z) const {
  const LegMotion<T> u = MotionOf(i, at.hip, z), turned = leg.slope * u;
  const T &gx = gravity_x_, &gy = gravity_y_;
  LegMotion<T> load;
  for (int k = 0; k < 4; ++k)
    load[k] = gx * leg.along[k] + gy * leg.up[k] - at.hip.rate * turned[k];
  load[2] += 0.5 * Dot(u, turned);
  if (follows_feet_ && IsDown(leg_[i])) {
    const Vector2<T> press = PressOf(i, at, z);
    load[2] += gx * (leg.along_turn[0] * press.x + leg.along_turn[1] * press.y) +
               gy * (leg.up_turn[0] * press.x + leg.up_turn[1] * press.y);
  }
  return load;
}

// What of the ground's force on a foot does not come of the accelerations, the leg's own force on
// its hip left out.
template <class T>
Vector2<T> Robot<T>::BornBy(const LegPlace& at, const LegInertia& leg,
                            const LegMotion<T>& u) const {
  const LegMotion<T> turned = leg.slope * u;
  const T &gx = gravity_x_, &gy = gravity_y_, &m = robot_.leg_mass;
  return {
      at.hip.rate * (Dot(leg.along_turn, u) - turned[0]) + gx * (leg.along[0] - m) + gy * leg.up[0],
      at.hip.rate * (Dot(leg.up_turn, u) - turned[1]) + gx * leg.along[1] + gy * (leg.up[1] - m)};
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
      energy += leg.law.StrainEnergy(FootOf(leg), PlaceOf(leg, i, HipOf(frame, i, z), z));
    if (has_leg_mass_) {
      const LegPlace at = LegOf(frame, i, z);
      const LegInertia inertia = InertiaOf(i, at);
      const LegMotion<T> u = MotionOf(i, at.hip, z);
      T x = robot_.leg_mass * (z[kX] + at.hip.x + at.x),
        y = robot_.leg_mass * (z[kY] + at.hip.y + at.y);
      if (follows_feet_ && IsDown(leg)) {
        const Vector2<T> press = PressOf(i, at, z);
        x += (inertia.along[0] - robot_.leg_mass) * press.x + inertia.along[1] * press.y;
        y += inertia.up[0] * press.x + (inertia.up[1] - robot_.leg_mass) * press.y;
      }
      energy += 0.5 * Dot(u, inertia.mass * u) - gravity_x_ * x - gravity_y_ * y;
    }
    if (robot_.control == MotorControl::kLocked) continue;
    energy += 0.5 * hub_[i] * z[Rate(i)] * z[Rate(i)];
    if (leg.geared()) {
      const T& rate = z[RotorRate(leg)];
      energy += 0.5 * (robot_.rotor_inertia - hub_[i]) * rate * rate +
                leg.gear.Energy(leg.teeth, z[Twist(leg)]);
    }
    if (robot_.control == MotorControl::kHeld) {
      const T off = robot_.angle[i] - MotorAngle(i, z);
      energy += 0.5 * robot_.motor_kp * off * off;
    }
  }
  return energy;
}

}  // namespace hoplab
