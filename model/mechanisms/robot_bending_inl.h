#pragma once

#include <array>
#include <cmath>

#include "base/units.h"
#include "model/mechanisms/robot_legs_inl.h"

// How a robot's legs bend in the air, and what of that goes over to the ground and back: M98.

namespace hoplab {

// M98: a leg in the air bends.
template <class T>
typename Robot<T>::LegInertia Robot<T>::LegInAir(const T& angle) const {
  LegInertia leg = RigidLeg(angle);
  if (!follows_legs_) return leg;
  const LegBending& mode = FirstBending();
  const double c = std::cos(Value(angle)), s = std::sin(Value(angle));
  Vector2<double> mean{c * mode.along - s * mode.up, s * mode.along + c * mode.up};
  double whole = 1.0;
  for (LegForm& form : leg.form) {
    form.LetBend(whole, mean.x, mean.y, whole * mode.about);
    mean = {-mean.y, mean.x};
    whole = 0.0;
  }
  leg.has_own = true;
  return leg;
}

// M98: where the bending takes the point of the leg that is lowest, per displacement of the mode.
template <class T>
Vector2<T> Robot<T>::ContactBending(const T& angle) const {
  using std::cos;
  using std::sin;
  const T beta = angle - 2.0 * kPi * TurnsOf(Value(angle));
  if (Value(beta) > 0.0) {
    const LegShape shape = LegShapeAt(kPi - Value(beta));
    const auto at = [&](int k) { return Chain(beta, shape.value[k], -shape.slope[k]); };
    return {at(LegShape::kContactX), at(LegShape::kContactY)};
  }
  const Vector2<double>& toe = FirstBending().toe;
  const T c = cos(beta), s = sin(beta);
  return {c * toe.x - s * toe.y, s * toe.x + c * toe.y};
}

// M98: how far above where it would be unbent a leg holds its foot, or would have to, for its foot
// not to be drawn down there: a leg that swings down comes to bear only when it can press.
template <class T>
T Robot<T>::HeldUp(int i, const T& angle, const T* z) const {
  using std::cos;
  using std::sin;
  const T& bent = z[Bent(i)];
  const Vector2<T> at = ContactBending(angle);
  const T beta = angle - 2.0 * kPi * TurnsOf(Value(angle));
  // M68 at no load, seen along the tangent at the contact.
  const T& whole = leg_[i].law.length();
  const bool rolling = Value(beta) > 0.0;
  const T arc = rolling ? T(whole - beta) : whole;
  const T up = bent * at.y;
  if (Value(arc) < robot_detail::kLeastArc) return up;
  const T s = sin(arc), c = cos(arc);
  const T xx = 1.5 * arc - 2.0 * s + 0.5 * s * c, xy = 1.0 - c - 0.5 * s * s,
          yy = 0.5 * (arc - s * c);
  T soft = xx, slant = xy;
  if (!rolling) {  // the tangent at the toe is at -beta
    const T c2 = cos(beta) * cos(beta), cs = cos(beta) * sin(beta), s2 = 1.0 - c2;
    soft = c2 * xx - 2.0 * cs * xy + s2 * yy;
    slant = cs * (xx - yy) + (c2 - s2) * xy;
  }
  const T free = bent * at.x * slant / soft;
  return Value(up) > Value(free) ? up : free;
}

// What a leg that lands is bent by along the ground goes over into where its foot stands.
template <class T>
void Robot<T>::TakeBendAlong(int i, const T& angle, T* z) {
  z[Contact(i)] += z[Bent(i)] * ContactBending(angle).x;
  z[Bent(i)] = T(0.0);
}

// M98: a leg that hangs down and lands before it would unbent may not press even so, where its
// points are drawn up: it has but brushed the ground and goes on unbent.
template <class T>
void Robot<T>::GoOnIfBrushed(int i, const T& t, T* z) {
  const Frame frame(z[Pitch()] - p_.slope);
  const Hip hip = HipOf(frame, i, z);
  if (!(Value(HeightOf(leg_[i], hip, z) - Reach(hip.angle)) > kAtZero * size_)) return;
  if (Value(ForcesOf(frame, t, z).ground[i].y) > 0.0) return;
  SpringOff(i, z);
  z[Bent(i)] = T(0.0);
  LiftOff(i, z);
}

// M98: how far the mode is bent by what the ground held, with no more energy than that of the leg.
template <class T>
T Robot<T>::BendLeft(int i, const Hip& hip, const T* z) const {
  using std::sqrt;
  const RobotLeg<T>& law = leg_[i].law;
  const ClampedPlace<T> place = PlaceOf(leg_[i], i, hip, z);
  const ClampedLoad<T> load = law.At(FootOf(leg_[i]), place, false);
  const Vector2<T> at = ContactBending(hip.angle);
  const T force = at.x * load.fx + at.y * load.fy, &k = law.bending_stiffness();
  const T ground = 0.5 * robot_.ground_compliance * load.fy * load.fy;
  const T held = 2.0 * k * (law.StrainEnergy(FootOf(leg_[i]), place) - ground);
  if (!(Value(held) > 0.0 && Value(force * force) > Value(held))) return force / k;
  return (Value(force) < 0.0 ? -1.0 : 1.0) * sqrt(held) / k;
}

}  // namespace hoplab
