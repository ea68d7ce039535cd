#pragma once

#include "model/mechanisms/robot_events_inl.h"

// What a robot's foot on the ground goes over into: rolling, its toe, sliding, holding; M74 to M76,
// M89.

namespace hoplab {

// The leg goes over to its toe, or lies down on its arc again.
template <class T>
void Robot<T>::RollOnto(int i, Stance to, T* z) {
  Leg& leg = leg_[i];
  if (follows_legs_) ChangeStance(i, to, z);
  leg.stance = to;
  if (foot_has_inertia_ || leg.slides == 0.0) {
    const T along = p_.r * leg.law.length();
    if (to == Stance::kToe)
      z[Contact(i)] += along;
    else
      z[Contact(i)] -= along;
  }
  leg.law.Restart();
}

template <class T>
void Robot<T>::SlideAway(const GuardRef& guard, T* z) {
  Leg& leg = leg_[guard.leg];
  const Hip hip = HipOf(Frame(z[Pitch()] - p_.slope), guard.leg, z);
  if (!foot_has_inertia_ &&
      !leg.law.CanSlide(guard.side, FootOf(leg), PlaceOf(leg, guard.leg, hip, z))) {
    LiftOff(guard.leg, z);
    return;
  }
  leg.slides = guard.side;
  if (!foot_has_inertia_) leg.law.Restart();
}

template <class T>
void Robot<T>::HoldFoot(int i, const T& t, T* z) {
  if (foot_has_inertia_) {
    Stick(i, t, z);
    return;
  }
  Leg& leg = leg_[i];
  const Hip hip = HipOf(Frame(z[Pitch()] - p_.slope), i, z);
  const ClampedLoad<T> load = leg.law.At(FootOf(leg), PlaceOf(leg, i, hip, z), false);
  z[Contact(i)] = z[kX] + ClampOf(hip).x + load.lead;
  leg.slides = 0.0;
  leg.law.Restart();
}

}  // namespace hoplab
