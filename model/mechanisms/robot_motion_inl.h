#pragma once

#include <array>

#include "model/mechanisms/motion_equations.h"
#include "model/mechanisms/robot_legs_inl.h"

// How a robot whose legs have mass moves: Lagrange's equations of body, motors and feet, leg by leg
// eliminated, and what the ground bears (M83, M92).

namespace hoplab {

/// Right side of the equations of motion, or momenta.
template <class T>
struct Robot<T>::Sides : AllMotions<T> {
  // What acts on a leg's motion, at its hip.
  void Add(int i, const Hip& hip, const LegMotion<T>& load) {
    this->x += load[0];
    this->y += load[1];
    this->pitch += hip.x * load[1] - hip.y * load[0] + load[2];
    this->motor[i] += load[2];
    this->own[i] += load[3];
  }
};

// Legs' own motions and motors are eliminated by values.
template <class T>
MotionEquations Robot<T>::EquationsOf(const Vector2<T>& com, const MovingLegs& legs) const {
  MotionEquations equations({Value(body_.mx), Value(body_.my)}, Value(com.x), Value(com.y),
                            Value(robot_.pitch_inertia));
  for (int i = 0; i < legs_; ++i) {
    const LegInertia& leg = legs.inertia[i];
    const LegForm& form = leg.form[0];
    const double m = Value(*leg.mass), scale[4] = {1.0, 1.0, Value(*leg.length), 1.0};
    double mass[4][4];
    for (int j = 0; j < leg.motions(); ++j)
      for (int k = 0; k < leg.motions(); ++k)
        mass[j][k] = m * scale[j] * scale[k] * form.mass[j][k];
    LegMotion<double> own;
    if (leg.has_own)
      for (int k = 0; k < 4; ++k)
        own[k] = mass[3][k] + Value(leg.lean) * (m * scale[k] * form.up[k] - mass[1][k]);
    const double hub = Value(hub_[i]);
    equations.Add(Value(legs.hip[i].x), Value(legs.hip[i].y), mass, leg.has_own ? &own : nullptr,
                  robot_.control == MotorControl::kLocked || leg_[i].is_held ? nullptr : &hub);
  }
  equations.Eliminate();
  return equations;
}

// What the accelerations (or rates) `a` leave of the sides.
template <class T>
typename Robot<T>::Sides Robot<T>::Left(const Vector2<T>& com, const MovingLegs& legs,
                                        const Sides& sides, const AllMotions<double>& a) const {
  Sides left = sides;
  const T fx = body_.mx * (a.x - a.pitch * com.y), fy = body_.my * (a.y + a.pitch * com.x);
  left.x -= fx;
  left.y -= fy;
  left.pitch -= a.pitch * robot_.pitch_inertia + com.x * fy - com.y * fx;
  for (int i = 0; i < legs_; ++i) {
    const Hip& hip = legs.hip[i];
    const LegInertia& leg = legs.inertia[i];
    const LegMotion<T> u = leg.Unit(
        {a.x - a.pitch * hip.y, a.y + a.pitch * hip.x, T(a.pitch + a.motor[i]), T(a.own[i])});
    LegMotion<T> taken = leg.Momenta(u);
    for (T& number : taken) number = -number;
    left.Add(i, hip, taken);
    left.motor[i] -= a.motor[i] * hub_[i];
  }
  return left;
}

// Gives what the sides do to the rates, in the places of dz. The masses' own derivatives come in by
// what the solution leaves of the sides.
template <class T>
void Robot<T>::SolveMotion(const Vector2<T>& com, const MovingLegs& legs, const Sides& sides, T* dz,
                           T* holding) const {
  const MotionEquations equations = EquationsOf(com, legs);
  AllMotions<T> a;
  if constexpr (kJetWidth<T> == 0) {
    a = equations.Solve(sides, holding);
  } else {
    AllMotions<double> values{sides.x.a, sides.y.a, sides.pitch.a};
    for (int i = 0; i < legs_; ++i) {
      values.motor[i] = sides.motor[i].a;
      values.own[i] = sides.own[i].a;
    }
    values = equations.Solve(values);
    a = equations.template Solve<T>(Left(com, legs, sides, values), holding);
    a.x += values.x;
    a.y += values.y;
    a.pitch += values.pitch;
    for (int i = 0; i < legs_; ++i) {
      a.motor[i] += values.motor[i];
      a.own[i] += values.own[i];
    }
  }
  dz[kVx] = a.x;
  dz[kVy] = a.y;
  dz[Pitch() + 1] = a.pitch;
  for (int i = 0; i < legs_; ++i) {
    dz[Rate(i)] = a.motor[i];
    if (follows_legs_) dz[OwnRate(i)] = a.own[i];
  }
}

// What leg i's hip, base and foot do under the rates (or accelerations, but for those of M72).
template <class T>
LegMotion<T> Robot<T>::MotionUnder(int i, const Hip& hip, const T* rates) const {
  const T& turn = rates[Pitch() + 1];
  return {rates[kVx] - turn * hip.y, rates[kVy] + turn * hip.x, turn + rates[Rate(i)],
          follows_legs_ ? rates[OwnRate(i)] : T(0.0)};
}

// M92: the ground's force on a foot.
template <class T>
Vector2<T> Robot<T>::GroundForce(const Frame& frame, int i, const Push& push, const T* z,
                                 const T* dz) const {
  const Hip hip = HipOf(frame, i, z);
  const LegInertia leg = InertiaOf(i, hip);
  const T turn2 = z[Pitch() + 1] * z[Pitch() + 1];
  LegMotion<T> a = MotionUnder(i, hip, dz);
  a[0] -= turn2 * hip.x;
  a[1] -= turn2 * hip.y;
  a = leg.Unit(a);
  const LegMotion<T> carried = leg.Carried(a);
  const Vector2<T> born = LoadOf(i, hip, leg, z).born;
  const ClampedLoad<T>& load = push.load[i];
  return {load.fx + load.damped_x + *leg.mass * (leg.Along(a) - carried[0]) + born.x,
          load.fy + load.damped_y + *leg.mass * (leg.Up(a) - carried[1]) + born.y};
}

template <class T>
struct Robot<T>::Forces {
  std::array<ClampedLoad<T>, kMaxLegs> load;  // of each leg that is down
  std::array<Vector2<T>, kMaxLegs> ground;    // on its foot, of one with mass (M92) [N]
  std::array<T, kMaxLegs> holding;            // of each hip that is held [N m]
};

template <class T>
typename Robot<T>::Forces Robot<T>::ForcesOf(const Frame& frame, const T& t, const T* z) const {
  Push& push = PushOf(frame, t, z);
  std::array<T, kMaxStates> rates;
  Forces forces;
  Accelerate(frame, push, z, rates.data(), forces.holding.data());
  if (lags_shortly_) LagShortly(frame, push, z, rates.data(), forces.holding.data());
  forces.load = push.load;
  for (int i = 0; i < legs_ && follows_legs_; ++i)
    if (IsDown(leg_[i])) forces.ground[i] = GroundForce(frame, i, push, z, rates.data());
  return forces;
}

// M83 to its first order, of legs that have a derivative by their mass, but none: what a kilogram
// of each would add to the accelerations, by values.
template <class T>
void Robot<T>::AddFirstMass(const Frame& frame, const T* z, T* dz, T* holding) const {
  const auto turned = [&](const T& x, const T& y) {
    const double c = Value(frame.cos_pitch), s = Value(frame.sin_pitch);
    return Vector2<double>{c * Value(x) - s * Value(y), s * Value(x) + c * Value(y)};
  };
  const double turn = Value(z[Pitch() + 1]), ax = Value(dz[kVx]), ay = Value(dz[kVy]),
               spin = Value(dz[Pitch() + 1]);
  AllMotions<double> sides;
  for (int i = 0; i < legs_; ++i) {
    const Vector2<double> hip = turned(robot_.hip_x[i], robot_.hip_y[i]);
    const RobotLeg<T>& law = leg_[i].law;
    typename Robot<double>::LegInertia leg;
    SetRigidForms(law.Centre(Value(frame.pitch) + Value(z[Angle(i)])), law.inertia(), leg.form);
    const double length = Value(law.unit_length()), rate = turn + Value(z[Rate(i)]);
    const LegMotion<double> u{Value(z[kVx]) - turn * hip.y, Value(z[kVy]) + turn * hip.x,
                              length * rate, 0.0};
    const LegMotion<double> held{turn * turn * hip.x - ax + spin * hip.y,
                                 turn * turn * hip.y - ay - spin * hip.x,
                                 -length * (spin + Value(dz[Rate(i)])), 0.0};
    double moment;
    const LegMotion<double> load = UnitLoad(leg, u, rate, Value(gravity_x_), Value(gravity_y_),
                                            moment),
                            carried = leg.Carried(held);
    const double fx = load[0] + carried[0], fy = load[1] + carried[1];
    moment += length * (load[2] + carried[2]);
    sides.x += fx;
    sides.y += fy;
    sides.pitch += hip.x * fy - hip.y * fx + moment;
    sides.motor[i] = moment;
  }
  const Vector2<double> com = turned(robot_.com_x, robot_.com_y);
  const double added =
      (sides.pitch + com.y * sides.x - com.x * sides.y) / Value(robot_.pitch_inertia);
  dz[kVx] += robot_.leg_mass * (sides.x / Value(body_.mx) + com.y * added);
  dz[kVy] += robot_.leg_mass * (sides.y / Value(body_.my) - com.x * added);
  dz[Pitch() + 1] += robot_.leg_mass * added;
  if (robot_.control == MotorControl::kLocked) return;
  for (int i = 0; i < legs_; ++i) {
    if (!leg_[i].is_held) dz[Rate(i)] += robot_.leg_mass * (sides.motor[i] / Value(hub_[i]));
    if (holding) holding[i] += robot_.leg_mass * sides.motor[i];
  }
}

// M83 with the matrices of M89.
template <class T>
void Robot<T>::AccelerateWithLegMass(const Frame& frame, const Push& push, const T* z, T* dz,
                                     T* holding) const {
  const Vector2<T>& com = push.com;
  const T& turn = z[Pitch() + 1];
  const T turn2 = turn * turn;
  MovingLegs legs;
  Sides sides;
  sides.x = push.force_x + body_.mx * body_.gravity_x + body_.mx * turn2 * com.x;
  sides.y = push.force_y + body_.my * body_.gravity_y + body_.my * turn2 * com.y;
  sides.pitch = push.moment + com.x * sides.y - com.y * sides.x;
  for (int i = 0; i < legs_; ++i) {
    const Hip& hip = legs.hip[i] = HipOf(frame, i, z);
    const LegInertia& leg = legs.inertia[i] = InertiaOf(i, hip);
    const LegLoad own = LoadOf(i, hip, leg, z);
    // The hip is drawn towards the reference point as it turns about it.
    LegMotion<T> load = leg.Momenta({turn2 * hip.x, turn2 * hip.y, T(0.0), T(0.0)});
    for (int k = 0; k < leg.motions(); ++k) load[k] += own.load[k];
    if (Bends(i)) {
      const RobotLeg<T>& law = leg_[i].law;
      load[3] -= law.bending_stiffness() * (z[Bent(i)] + law.tau() * z[OwnRate(i)]);
    } else if (leg.has_own) {
      const ClampedLoad<T>& bent = push.load[i];
      load[3] -= bent.fx + bent.damped_x + leg.lean * (bent.fy + bent.damped_y + own.born.y);
    }
    sides.Add(i, hip, load);
    sides.motor[i] += push.on_motor[i];
  }
  SolveMotion(com, legs, sides, dz, holding);
}

}  // namespace hoplab
