#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "model/mechanisms/robot_dynamics_inl.h"
#include "model/mechanisms/robot_leg_shape.h"

// The mass of a robot's legs: rigid in the air (M82), by their quasi-static shape on the ground
// (M89), and what they take up and give as they land and leave (M90, M91).

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
  leg.mass = {m, zero, -y, zero, m, x, zero, 2.0 * m * p_.r * p_.r, zero, zero};
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
  const T angle = at.hip.angle - 2.0 * robot_detail::kPi * own.turns;
  // On its toe the whole leg turns with its base.
  const F shape = LegShapeAt(rolling ? robot_detail::kPi - Value(angle) : robot_detail::kPi);
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
  const T angle = at.hip.angle - 2.0 * robot_detail::kPi * leg.turns;
  const T c = p_.r * cos(angle), s = p_.r * sin(angle);
  T lead = 2.0 * s, height = 2.0 * c;
  if (leg.stance == Stance::kRolling) {
    lead = s - p_.r * (leg.arc.length() - angle);
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
  const T own = locked ? T(1.0) : T(1.0 / (robot_.rotor_inertia + e[2][2]));
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

// Momenta of body and motors, and of the legs as they are.
template <class T>
void Robot<T>::AddMomentum(const Vector2<T>& com, const T* z, Sides& sides) const {
  const T& turn = z[Pitch() + 1];
  const T px = p_.m * (z[kVx] - turn * com.y), py = p_.m * (z[kVy] + turn * com.x);
  sides.x += px;
  sides.y += py;
  sides.pitch += robot_.pitch_inertia * turn + com.x * py - com.y * px;
  for (int i = 0; i < legs_; ++i) sides.motor[i] += robot_.rotor_inertia * z[Rate(i)];
}

// A foot that slides keeps on the edge of its cone through a blow on another leg.
template <class T>
void Robot<T>::AddLegMomentum(int i, const LegPlace& at, const LegInertia& leg,
                              const LegMotion<T>& u, Sides& sides) const {
  LegMotion<T> momentum = leg.mass * u;
  if (leg.foot) momentum[3] = Dot(leg.row, u);
  sides.Add(i, at.hip, momentum);
}

template <class T>
void Robot<T>::PutRates(const T* rates, T* z) const {
  z[kVx] = rates[kVx];
  z[kVy] = rates[kVy];
  z[Pitch() + 1] = rates[Pitch() + 1];
  for (int i = 0; i < legs_; ++i) {
    z[Rate(i)] = rates[Rate(i)];
    if (foot_has_inertia_) z[FootSpeed(i)] = rates[FootSpeed(i)];
  }
}

// M90: leg i comes down as a rigid body, and its foot stops, or goes on along the ground.
template <class T>
void Robot<T>::Blow(int i, T* z) {
  const Frame frame(z[Pitch()] - p_.slope);
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  const double mu = Value(robot_.friction);
  Leg& leg = leg_[i];
  std::array<LegPlace, kMaxLegs> at;
  std::array<LegInertia, kMaxLegs> legs;
  Sides sides;
  sides.Clear();
  AddMomentum(com, z, sides);
  LegMotion<T> taken{};
  Vector2<T> had{T(0.0), T(0.0)};  // the leg's momentum
  for (int j = 0; j < legs_; ++j) {
    at[j] = LegOf(frame, j, z);
    legs[j] = InertiaOf(j, at[j]);
    const LegMotion<T> u = MotionOf(j, at[j].hip, z);
    if (j != i) {
      AddLegMomentum(j, at[j], legs[j], u, sides);
      continue;
    }
    for (int k = 0; k < 4; ++k)
      taken[k] = legs[j].along[k] * u[0] + legs[j].up[k] * u[1] + legs[j].turn[k] * u[2];
    had = {robot_.leg_mass * (u[0] - at[j].y * u[2]), robot_.leg_mass * (u[1] + at[j].x * u[2])};
    sides.Add(j, at[j].hip, taken);
  }
  std::array<T, kMaxStates> rates;
  SolveMotion(com, at, legs, sides, rates.data());
  if (HasCone()) {
    const LegMotion<T> u = MotionUnder(i, at[i].hip, rates.data());
    const LegMotion<T> carried = legs[i].mass * u;
    const double along = Value(Dot(legs[i].along, u) - carried[0] + taken[0] - had.x),
                 up = Value(Dot(legs[i].up, u) - carried[1] + taken[1] - had.y);
    if (!(std::abs(along) <= mu * up)) {
      leg.slides = along > 0.0 ? -1.0 : 1.0;
      LetFootMove(at[i], leg.slides, legs[i]);
      // What it takes up of the motion along, and the friction of the blow.
      const LegMotion<T> before = MotionOf(i, at[i].hip, z);
      sides.foot[i] = legs[i].along[3] * before[0] + legs[i].up[3] * before[1] +
                      legs[i].turn[3] * before[2] + legs[i].lean * (had.y - taken[1]);
      SolveMotion(com, at, legs, sides, rates.data());
    }
  }
  PutRates(rates.data(), z);
}

// M91: the leg leaves the ground as a rigid body; what its points had along the motions that are
// free then is kept.
template <class T>
void Robot<T>::SpringOff(int i, T* z) {
  const Frame frame(z[Pitch()] - p_.slope);
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  std::array<LegPlace, kMaxLegs> at;
  std::array<LegInertia, kMaxLegs> legs;
  Sides sides;
  sides.Clear();
  AddMomentum(com, z, sides);
  for (int j = 0; j < legs_; ++j) {
    at[j] = LegOf(frame, j, z);
    legs[j] = InertiaOf(j, at[j]);
    const LegMotion<T> u = MotionOf(j, at[j].hip, z);
    if (j != i) {
      AddLegMomentum(j, at[j], legs[j], u, sides);
      continue;
    }
    sides.Add(j, at[j].hip,
              {Dot(legs[j].along, u), Dot(legs[j].up, u), Dot(legs[j].turn, u), T(0.0)});
    legs[j] = RigidLeg(at[j]);
  }
  std::array<T, kMaxStates> rates;
  SolveMotion(com, at, legs, sides, rates.data());
  PutRates(rates.data(), z);
}

// The shape goes over from rolling to the toe or back: momenta are kept.
template <class T>
void Robot<T>::ChangeStance(int i, Stance to, T* z) {
  const Frame frame(z[Pitch()] - p_.slope);
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  std::array<LegPlace, kMaxLegs> at;
  std::array<LegInertia, kMaxLegs> legs;
  Sides sides;
  sides.Clear();
  AddMomentum(com, z, sides);
  for (int j = 0; j < legs_; ++j) {
    at[j] = LegOf(frame, j, z);
    legs[j] = InertiaOf(j, at[j]);
    AddLegMomentum(j, at[j], legs[j], MotionOf(j, at[j].hip, z), sides);
  }
  leg_[i].stance = to;
  legs[i] = InertiaOf(i, at[i]);
  std::array<T, kMaxStates> rates;
  SolveMotion(com, at, legs, sides, rates.data());
  PutRates(rates.data(), z);
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
    energy += 0.5 * robot_.rotor_inertia * z[Rate(i)] * z[Rate(i)];
    if (robot_.control == MotorControl::kHeld) {
      const T off = robot_.angle[i] - z[Angle(i)];
      energy += 0.5 * robot_.motor_kp * off * off;
    }
  }
  return energy;
}

}  // namespace hoplab
