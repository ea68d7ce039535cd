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
  std::array<LegPlace, kMaxLegs> at;
  std::array<LegInertia, kMaxLegs> legs;
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
  sides.Clear();
  const T& turn = z[Pitch() + 1];
  const T px = p_.m * (z[kVx] - turn * now.com.y), py = p_.m * (z[kVy] + turn * now.com.x);
  sides.x += px;
  sides.y += py;
  sides.pitch += robot_.pitch_inertia * turn + now.com.x * py - now.com.y * px;
  for (int i = 0; i < legs_; ++i) {
    sides.motor[i] += hub_[i] * z[Rate(i)];
    now.at[i] = LegOf(frame, i, z);
    now.legs[i] = InertiaOf(i, now.at[i]);
    if (i == without) continue;
    const LegMotion<T> u = MotionOf(i, now.at[i].hip, z);
    LegMotion<T> momentum = now.legs[i].mass * u;
    if (now.legs[i].foot) momentum[3] = Dot(now.legs[i].row, u);
    sides.Add(i, now.at[i].hip, momentum);
  }
  return now;
}

template <class T>
void Robot<T>::GoOnWith(const Impact& now, T* z) const {
  std::array<T, kMaxStates> rates;
  SolveMotion(now.com, now.at, now.legs, now.sides, rates.data());
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
  Impact now = MomentaOf(z, i);
  LegInertia& leg = now.legs[i];
  const LegPlace& at = now.at[i];
  const LegMotion<T> before = MotionOf(i, at.hip, z);
  LegMotion<T> taken{};
  for (int k = 0; k < 4; ++k)
    taken[k] = leg.along[k] * before[0] + leg.up[k] * before[1] + leg.turn[k] * before[2];
  now.sides.Add(i, at.hip, taken);
  if (HasCone()) {
    const Vector2<T> had{robot_.leg_mass * (before[0] - at.y * before[2]),
                         robot_.leg_mass * (before[1] + at.x * before[2])};
    std::array<T, kMaxStates> rates;
    SolveMotion(now.com, now.at, now.legs, now.sides, rates.data());
    const LegMotion<T> u = MotionUnder(i, at.hip, rates.data());
    const LegMotion<T> carried = leg.mass * u;
    const double along = Value(Dot(leg.along, u) - carried[0] + taken[0] - had.x),
                 up = Value(Dot(leg.up, u) - carried[1] + taken[1] - had.y);
    if (!(std::abs(along) <= Value(robot_.friction) * up)) {
      leg_[i].slides = along > 0.0 ? -1.0 : 1.0;
      LetFootMove(at, leg_[i].slides, leg);
      // What it takes up of the motion along, and the friction of the blow.
      now.sides.foot[i] = leg.along[3] * before[0] + leg.up[3] * before[1] +
                          leg.turn[3] * before[2] + leg.lean * (had.y - taken[1]);
    }
  }
  GoOnWith(now, z);
}

// M91: the leg leaves the ground as a rigid body; what its points had along the motions that are
// free then is kept.
template <class T>
void Robot<T>::SpringOff(int i, T* z) {
  Impact now = MomentaOf(z, i);
  LegInertia& leg = now.legs[i];
  const LegMotion<T> u = MotionOf(i, now.at[i].hip, z);
  now.sides.Add(i, now.at[i].hip, {Dot(leg.along, u), Dot(leg.up, u), Dot(leg.turn, u), T(0.0)});
  leg = RigidLeg(now.at[i]);
  GoOnWith(now, z);
}

// The shape goes over from rolling to the toe or back: momenta are kept.
template <class T>
void Robot<T>::ChangeStance(int i, Stance to, T* z) {
  Impact now = MomentaOf(z, /*without=*/-1);
  leg_[i].stance = to;
  now.legs[i] = InertiaOf(i, now.at[i]);
  GoOnWith(now, z);
}

}  // namespace hoplab
