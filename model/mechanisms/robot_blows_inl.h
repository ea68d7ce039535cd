#pragma once

#include <array>

#include "model/mechanisms/robot_motion_inl.h"

// What a robot's legs with mass take up and give as they land, leave and roll onto their toes: M90,
// M91.

namespace hoplab {

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

}  // namespace hoplab
