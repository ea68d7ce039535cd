#pragma once

#include <array>
#include <cmath>

#include "model/mechanisms/robot_motion_inl.h"

// What a robot's legs with mass take up and give as they land, leave and roll onto their toes: M90,
// M91.

namespace hoplab {

// What an instant at which a leg changes its way begins with.
template <class T>
struct Robot<T>::Impact {
  Vector2<T> com;
  MovingLegs legs;
  Sides sides;  // momenta
};

// Momenta of body, motors and legs as they are, but for leg `without`. A foot that slides keeps on
// the edge of its cone through a blow on another leg.
template <class T>
typename Robot<T>::Impact Robot<T>::MomentaOf(const T* z, int without) const {
  const Frame frame(z[Pitch()] - p_.slope);
  Impact now;
  now.com = frame.Turn(robot_.com_x, robot_.com_y);
  Sides& sides = now.sides;
  const T& turn = z[Pitch() + 1];
  const T px = body_.mx * (z[kVx] - turn * now.com.y), py = body_.my * (z[kVy] + turn * now.com.x);
  sides.x += px;
  sides.y += py;
  sides.pitch += robot_.pitch_inertia * turn + now.com.x * py - now.com.y * px;
  for (int i = 0; i < legs_; ++i) {
    sides.motor[i] += hub_[i] * z[Rate(i)];
    const Hip& hip = now.legs.hip[i] = HipOf(frame, i, z);
    const LegInertia& leg = now.legs.inertia[i] = InertiaOf(i, hip);
    if (i != without) sides.Add(i, hip, leg.Momenta(leg.Unit(MotionOf(i, hip, z))));
  }
  return now;
}

template <class T>
void Robot<T>::GoOnWith(const Impact& now, T* z) {
  LetHipsGo();
  std::array<T, kMaxStates> rates;
  SolveMotion(now.com, now.legs, now.sides, rates.data());
  z[kVx] = rates[kVx];
  z[kVy] = rates[kVy];
  z[Pitch() + 1] = rates[Pitch() + 1];
  for (int i = 0; i < legs_; ++i) {
    z[Rate(i)] = rates[Rate(i)];
    if (follows_legs_) z[OwnRate(i)] = rates[OwnRate(i)];
    // A foot that the blow turns round slides that way from here on.
    if (FootMoves(i) && leg_[i].slides * Value(z[OwnRate(i)]) < 0.0)
      leg_[i].slides = -leg_[i].slides;
  }
  FindTurns(z);
}

// M90: leg i comes down as it moves in the air, and its foot stops, or goes on along the ground.
template <class T>
void Robot<T>::Blow(int i, T* z) {
  LetHipsGo();
  Impact now = MomentaOf(z, i);
  LegInertia& leg = now.legs.inertia[i];
  const Hip& hip = now.legs.hip[i];
  const T& m = *leg.mass;
  const LegInertia in_air = LegInAir(hip.angle);
  const LegMotion<T> before = in_air.Unit({hip.vx, hip.vy, hip.rate, z[OwnRate(i)]});
  const auto taken_by = [&](int k) { return leg.Share(k, before); };
  const LegMotion<T> taken = leg.Real({taken_by(0), taken_by(1), taken_by(2), T(0.0)});
  now.sides.Add(i, hip, taken);
  if (HasCone()) {
    const Vector2<T> had{m * in_air.Along(before), m * in_air.Up(before)};
    std::array<T, kMaxStates> rates;
    SolveMotion(now.com, now.legs, now.sides, rates.data());
    const LegMotion<T> u = leg.Unit(MotionUnder(i, hip, rates.data())), carried = leg.Carried(u);
    const double along = Value(m * (leg.Along(u) - carried[0]) + taken[0] - had.x),
                 up = Value(m * (leg.Up(u) - carried[1]) + taken[1] - had.y);
    if (!(std::abs(along) <= Value(robot_.friction) * up)) {
      leg_[i].slides = along > 0.0 ? -1.0 : 1.0;
      LetFootMove(hip, leg_[i].slides, leg);
      // What it takes up of the motion along, and the friction of the blow.
      now.sides.own[i] = m * taken_by(3) + leg.lean * (had.y - taken[1]);
    }
  }
  GoOnWith(now, z);
}

// M91: the leg leaves the ground; what its points had along the motions that are free then is kept,
// and so is what of its bend the mode in the air can hold.
template <class T>
void Robot<T>::SpringOff(int i, T* z) {
  Impact now = MomentaOf(z, i);
  LegInertia& leg = now.legs.inertia[i];
  const Hip& hip = now.legs.hip[i];
  const LegMotion<T> u = leg.Unit(MotionOf(i, hip, z));
  const LegMotion<T> had = {leg.Along(u), leg.Up(u), leg.Turn(u), leg.Bending(u)};
  z[Bent(i)] = BendLeft(i, hip, z);
  leg = LegInAir(hip.angle);
  now.sides.Add(i, hip, leg.Real(had));
  GoOnWith(now, z);
}

// The shape goes over from rolling to the toe or back: momenta are kept.
template <class T>
void Robot<T>::ChangeStance(int i, Stance to, T* z) {
  Impact now = MomentaOf(z, /*without=*/-1);
  leg_[i].stance = to;
  now.legs.inertia[i] = InertiaOf(i, now.legs.hip[i]);
  GoOnWith(now, z);
}

}  // namespace hoplab
