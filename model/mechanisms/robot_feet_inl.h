#pragma once

#include <algorithm>
#include <cmath>

#include "model/mechanisms/robot.h"

// Feet of a robot that come to rest, or lose their hold.

namespace hoplab {

// A foot that comes to rest holds, but where it would be drawn the other way by more than its cone.
template <class T>
void Robot<T>::Stick(int i, const T& t, T* z) {
  const double went = leg_[i].slides;
  leg_[i].slides = 0.0;
  z[OwnRate(i)] = T(0.0);
  SlideOutsideCone(i, went, t, z);
}

// A foot that begins to hold where it cannot slides, but not the way it just came.
template <class T>
void Robot<T>::SlideOutsideCone(int i, double went, const T& t, const T* z) {
  const Forces forces = ForcesOf(Frame(z[Pitch()] - p_.slope), t, z);
  const double along = Value(forces.ground[i].x), up = Value(forces.ground[i].y);
  if (!(up > 0.0) || std::abs(along) <= Value(robot_.friction) * up) return;
  const double way = along > 0.0 ? -1.0 : 1.0;
  if (way != went) leg_[i].slides = way;
}

// Where accelerations jump, so do the forces on the other feet: one that holds may be beyond its
// cone.
template <class T>
void Robot<T>::AskCones(int except, const T& t, T* z) {
  if (!foot_has_inertia_) return;
  for (int i = 0; i < legs_; ++i)
    if (i != except && IsDown(leg_[i]) && leg_[i].slides == 0.0) {
      SlideOutsideCone(i, 0.0, t, z);
      GoOnIfBrushed(i, t, z);
    }
}

template <class T>
void Robot<T>::LiftOff(int i, T* z) {
  leg_[i].stance = Stance::kFlight;
  leg_[i].slides = 0.0;
  z[Contact(i)] = T(0.0);
  if (!follows_legs_) return;
  // The mode holds not all of what the arc gave way.
  const Hip hip = HipOf(Frame(z[Pitch()] - p_.slope), i, z);
  const T over = z[kY] + hip.y - Reach(hip.angle) + HeldUp(i, hip.angle, z);
  leg_[i].sunk = std::min(Value(over), 0.0);
  leg_[i].floor = 0.0;
}

}  // namespace hoplab
