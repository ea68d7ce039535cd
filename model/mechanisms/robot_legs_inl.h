#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "model/mechanisms/robot_dynamics_inl.h"
#include "model/mechanisms/robot_leg_shape.h"

// The mass of a robot's legs: in the air (M82), by their quasi-static shape on the ground
// (M89).

namespace hoplab {

/// A leg's mass in the way it is on the ground or in the air now: forms are functions of its angle.
/// Momenta and forces below are those of a leg of unit mass and length, as are the motions.
template <class T>
struct Robot<T>::LegInertia {
  // The forms are needed with their slopes only where numbers have some.
  static constexpr int kForms = kJetWidth<T> == 0 ? 2 : 3;

  bool has_own = false;                        // whether it has a motion of its own
  T lean{0.0};                                 // friction under a foot that slides, against its way
  const T *mass = nullptr, *length = nullptr;  // [kg], [m]
  T off{0.0};                                  // of its angle from that angle's value
  std::array<LegForm, kForms> form;            // there, and its derivatives by the angle

  int motions() const { return has_own ? 4 : 3; }

  LegMotion<T> Unit(const LegMotion<T>& u) const { return {u[0], u[1], *length * u[2], u[3]}; }
  /// With the leg's mass and length.
  LegMotion<T> Real(const LegMotion<T>& p) const {
    const T& m = *mass;
    return {m * p[0], m * p[1], m * *length * p[2], has_own ? T(m * p[3]) : T(0.0)};
  }

  /// Momenta of all motions, `order` times differentiated by the angle. Here and below S is T, or
  /// double for values alone.
  template <class S>
  LegMotion<S> Carried(const LegMotion<S>& u, int order = 0) const {
    LegMotion<S> p;
    for (int k = 0; k < motions(); ++k)
      p[k] = Follow([k](const LegForm& of) { return of.mass[k]; }, order, u);
    return p;
  }
  /// Momentum of the leg along and up.
  template <class S>
  S Along(const LegMotion<S>& u, int order = 0) const {
    return Follow([](const LegForm& of) { return of.along.data(); }, order, u);
  }
  template <class S>
  S Up(const LegMotion<S>& u, int order = 0) const {
    return Follow([](const LegForm& of) { return of.up.data(); }, order, u);
  }
  T Turn(const LegMotion<T>& u) const {
    return Follow([](const LegForm& of) { return of.turn.data(); }, 0, u);
  }
  T Bending(const LegMotion<T>& u) const {
    return Follow([](const LegForm& of) { return of.bending.data(); }, 0, u);
  }
  /// What all motions take to move it so, with its mass and length: the row of a foot's speed with
  /// its friction.
  LegMotion<T> Momenta(const LegMotion<T>& u) const {
    LegMotion<T> p = Carried(u);
    if (has_own) p[3] += lean * (Up(u) - p[1]);
    return Real(p);
  }
  /// How a force on all of the leg, or its motion in the air, bears on motion k.
  template <class S>
  S Share(int k, const S& along, const S& up) const {
    return Number<S>(&LegForm::along, k) * along + Number<S>(&LegForm::up, k) * up;
  }
  T Share(int k, const LegMotion<T>& in_air) const {
    return Share(k, in_air[0], in_air[1]) + Number<T>(&LegForm::turn, k) * in_air[2] +
           Number<T>(&LegForm::bending, k) * in_air[3];
  }

 private:
  template <class S>
  S Number(LegMotion<double> LegForm::*row, int k) const {
    if constexpr (kJetWidth<S> == 0)
      return (form[0].*row)[k];
    else
      return Chain(off, (form[0].*row)[k], (form[1].*row)[k]);
  }
  template <class Row, class S>
  S Follow(const Row& row_of, int order, const LegMotion<S>& u) const {
    const double* row = row_of(form[order]);
    S sum = row[0] * u[0];
    for (int k = 1; k < motions(); ++k) sum += row[k] * u[k];
    if constexpr (kJetWidth < S >> 0) {
      const double* by_angle = row_of(form[order + 1]);
      double slope = by_angle[0] * u[0].a;
      for (int k = 1; k < motions(); ++k) slope += by_angle[k] * u[k].a;
      sum.v += slope * off.v;
    }
    return sum;
  }
};

// M82: the leg as a rigid body that turns with its motor, of unit mass and length.
template <class T>
template <std::size_t kForms>
void Robot<T>::SetRigidForms(Vector2<double> centre, double inertia,
                             std::array<LegForm, kForms>& forms) {
  double whole = 1.0;
  for (LegForm& form : forms) {
    form.SetMass(whole, 0.0, whole, -centre.y, centre.x, inertia);
    form.along = {whole, 0.0, -centre.y, 0.0};
    form.up = {0.0, whole, centre.x, 0.0};
    form.turn = {-centre.y, centre.x, inertia, 0.0};
    centre = {-centre.y, centre.x};
    whole = inertia = 0.0;
  }
}
template <class T>
typename Robot<T>::LegInertia Robot<T>::RigidLeg(const T& angle) const {
  const RobotLeg<T>& law = leg_[0].law;
  LegInertia leg;
  leg.mass = &robot_.leg_mass;
  leg.length = &law.unit_length();
  leg.off = angle - Value(angle);
  SetRigidForms(law.Centre(Value(angle)), law.inertia(), leg.form);
  return leg;
}

// M89, of a foot that holds.
template <class T>
typename Robot<T>::LegInertia Robot<T>::StandingLeg(int i, const Hip& hip) const {
  using F = LegShape;
  const Leg& own = leg_[i];
  LegInertia leg;
  leg.mass = &robot_.leg_mass;
  leg.length = &own.law.unit_length();
  leg.off = hip.angle - Value(hip.angle);
  const double angle = Value(hip.angle) - 2.0 * kPi * own.turns;
  const bool rolling = own.stance == Stance::kRolling;
  const F shape = LegShapeAt(rolling ? kPi - angle : kPi);
  const auto set = [](LegForm& form, const auto& v, double sign) {
    form.SetMass(sign * v[F::kXX], sign * v[F::kXY], sign * v[F::kYY], sign * v[F::kXB],
                 sign * v[F::kYB], sign * v[F::kBB]);
    form.along = {sign * v[F::kAlongX], sign * v[F::kAlongY], sign * v[F::kAlongB], 0.0};
    form.up = {sign * v[F::kUpX], sign * v[F::kUpY], sign * v[F::kUpB], 0.0};
    form.turn = {sign * v[F::kTurnX], sign * v[F::kTurnY], sign * v[F::kTurnB], 0.0};
    form.bending = {sign * v[F::kBendingX], sign * v[F::kBendingY], sign * v[F::kBendingB], 0.0};
  };
  if (rolling) {
    set(leg.form[0], shape.value, 1.0);
    set(leg.form[1], shape.slope, -1.0);
    if constexpr (leg.kForms > 2) set(leg.form[2], shape.bend, 1.0);
    return leg;
  }
  // On its toe the whole leg turns with its base.
  const auto& v = shape.value;
  const double c = std::cos(angle), s = std::sin(angle), c2 = c * c - s * s, s2 = 2.0 * c * s;
  const double mean = 0.5 * (v[F::kXX] + v[F::kYY]), half = 0.5 * (v[F::kXX] - v[F::kYY]);
  const double even = 0.5 * (v[F::kAlongX] + v[F::kUpY]), odd = 0.5 * (v[F::kUpX] - v[F::kAlongY]),
               p = 0.5 * (v[F::kAlongX] - v[F::kUpY]), q = 0.5 * (v[F::kUpX] + v[F::kAlongY]);
  // A turning pair of numbers.
  const auto turned = [](double cosine, double sine, double x, double y) {
    return Vector2<double>{cosine * x - sine * y, sine * x + cosine * y};
  };
  Vector2<double> mass = turned(c2, s2, half, v[F::kXY]), sum = turned(c2, s2, p, q),
                  base = turned(c, s, v[F::kXB], v[F::kYB]),
                  centre = turned(c, s, v[F::kAlongB], v[F::kUpB]),
                  spin = turned(c, s, v[F::kTurnX], v[F::kTurnY]),
                  bend = turned(c, s, v[F::kBendingX], v[F::kBendingY]);
  double stays = 1.0;  // of what does not turn
  for (LegForm& form : leg.form) {
    form.SetMass(stays * mean + mass.x, mass.y, stays * mean - mass.x, base.x, base.y,
                 stays * v[F::kBB]);
    form.along = {stays * even + sum.x, sum.y - stays * odd, centre.x, 0.0};
    form.up = {sum.y + stays * odd, stays * even - sum.x, centre.y, 0.0};
    form.turn = {spin.x, spin.y, stays * v[F::kTurnB], 0.0};
    form.bending = {bend.x, bend.y, stays * v[F::kBendingB], 0.0};
    for (Vector2<double>* twice : {&mass, &sum}) *twice = {-2.0 * twice->y, 2.0 * twice->x};
    for (Vector2<double>* once : {&base, &centre, &spin, &bend}) *once = {-once->y, once->x};
    stays = 0.0;
  }
  return leg;
}

// M92: its friction goes with what the ground bears.
template <class T>
void Robot<T>::LetFootMove(const Hip& hip, double slides, LegInertia& leg) const {
  const LegInertia in_air = LegInAir(hip.angle);
  double whole = 1.0;
  for (std::size_t k = 0; k < leg.form.size(); ++k) {
    const LegForm& form = in_air.form[k];
    leg.form[k].LetFootMove(whole, form.along[2], form.along[3]);
    whole = 0.0;
  }
  leg.has_own = true;
  leg.lean = slides * robot_.friction;
}

template <class T>
typename Robot<T>::LegInertia Robot<T>::InertiaOf(int i, const Hip& hip) const {
  if (!follows_legs_ || !IsDown(leg_[i])) return LegInAir(hip.angle);
  LegInertia leg = StandingLeg(i, hip);
  if (FootMoves(i)) LetFootMove(hip, leg_[i].slides, leg);
  return leg;
}

template <class T>
LegMotion<T> Robot<T>::MotionOf(int i, const Hip& hip, const T* z) const {
  return {hip.vx, hip.vy, hip.rate, FootMoves(i) || Bends(i) ? z[OwnRate(i)] : T(0.0)};
}

// M89: where the hip is from where it would be over its foot with the leg unloaded.
template <class T>
Vector2<T> Robot<T>::PressOf(int i, const Hip& hip, const T* z) const {
  using std::cos;
  using std::sin;
  const Leg& leg = leg_[i];
  const T angle = hip.angle - 2.0 * kPi * leg.turns;
  const T c = p_.r * cos(angle), s = p_.r * sin(angle);
  T lead = 2.0 * s, height = 2.0 * c;
  if (leg.stance == Stance::kRolling) {
    lead = s - p_.r * (leg.law.length() - angle);
    height = p_.r + c;
  }
  return {z[kX] + hip.x + lead - z[Contact(i)], HeightOf(leg, hip, z) - height};
}

/// The legs of a robot as their masses are now.
template <class T>
struct Robot<T>::MovingLegs {
  std::array<Hip, kMaxLegs> hip;
  std::array<LegInertia, kMaxLegs> inertia;
};

/// What of a leg's forces does not come of the accelerations.
template <class T>
struct Robot<T>::LegLoad {
  LegMotion<T> load;  // the change of the mass matrix, and the weight [N, N m]
  Vector2<T> born;    // by the ground, the leg's own force on its hip left out [N]
};

// The same of a leg of unit mass and length; `moment` is what of it turns the base whatever that
// length.
template <class T>
template <class Inertia, class S>
LegMotion<S> Robot<T>::UnitLoad(const Inertia& leg, const LegMotion<S>& u, const S& rate,
                                const S& gx, const S& gy, S& moment) {
  const LegMotion<S> turned = leg.Carried(u, 1);
  LegMotion<S> p;
  S twice = u[0] * turned[0];
  for (int k = 1; k < leg.motions(); ++k) twice += u[k] * turned[k];
  for (int k = 0; k < leg.motions(); ++k) p[k] = leg.Share(k, gx, gy) - rate * turned[k];
  moment = 0.5 * twice;
  return p;
}

template <class T>
typename Robot<T>::LegLoad Robot<T>::LoadOf(int i, const Hip& hip, const LegInertia& leg,
                                            const T* z) const {
  const LegMotion<T> u = leg.Unit(MotionOf(i, hip, z));
  const T &gx = gravity_x_, &gy = gravity_y_, &m = *leg.mass;
  LegLoad all;
  T moment;
  const LegMotion<T> p = UnitLoad(leg, u, hip.rate, gx, gy, moment);
  all.load = leg.Real(p);
  if (follows_legs_ && IsDown(leg_[i])) {
    const Vector2<T> press = PressOf(i, hip, z);
    const LegMotion<T> pressed{press.x, press.y, T(0.0), T(0.0)};
    moment += gx * leg.Along(pressed, 1) + gy * leg.Up(pressed, 1);
    all.born = {m * (p[0] + hip.rate * leg.Along(u, 1) - gx),
                m * (p[1] + hip.rate * leg.Up(u, 1) - gy)};
  }
  if (Bends(i)) {
    const LegMotion<T> bent{T(0.0), T(0.0), T(0.0), z[Bent(i)]};
    moment += gx * leg.Along(bent, 1) + gy * leg.Up(bent, 1);
  }
  all.load[2] += m * moment;
  return all;
}

template <class T>
T Robot<T>::Energy(Mode, const T* z) const {
  AgeLegs(T(0.0));
  const Frame frame(z[Pitch()] - p_.slope);
  const Vector2<T> com = frame.Turn(robot_.com_x, robot_.com_y);
  const T& turn = z[Pitch() + 1];
  const T centre[4] = {z[kX] + com.x, z[kY] + com.y, z[kVx] - turn * com.y, z[kVy] + turn * com.x};
  T energy = body_.Energy(centre) + 0.5 * robot_.pitch_inertia * turn * turn;
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    if (IsDown(leg))
      energy += leg.law.StrainEnergy(FootOf(leg), PlaceOf(leg, i, HipOf(frame, i, z), z));
    if (has_leg_mass_) {
      const Hip hip = HipOf(frame, i, z);
      const LegInertia inertia = InertiaOf(i, hip), rigid = RigidLeg(hip.angle);
      const LegMotion<T> u = inertia.Unit(MotionOf(i, hip, z)), carried = inertia.Carried(u);
      const LegMotion<T> turns{T(0.0), T(0.0), *rigid.length, T(0.0)};
      T x = z[kX] + hip.x + rigid.Up(turns), y = z[kY] + hip.y - rigid.Along(turns);
      if (follows_legs_ && IsDown(leg)) {
        const Vector2<T> press = PressOf(i, hip, z);
        const LegMotion<T> pressed{press.x, press.y, T(0.0), T(0.0)};
        x += inertia.Along(pressed) - press.x;
        y += inertia.Up(pressed) - press.y;
      }
      if (Bends(i)) {
        const T& bend = z[Bent(i)];
        const LegMotion<T> bent{T(0.0), T(0.0), T(0.0), bend};
        x += inertia.Along(bent);
        y += inertia.Up(bent);
        energy += 0.5 * leg.law.bending_stiffness() * bend * bend;
      }
      T twice = u[0] * carried[0];
      for (int k = 1; k < inertia.motions(); ++k) twice += u[k] * carried[k];
      energy += *inertia.mass * (0.5 * twice - gravity_x_ * x - gravity_y_ * y);
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
