#pragma once

#include <array>

#include "model/mechanisms/robot_feet_inl.h"
#include "model/mechanisms/robot_hips_inl.h"

// What jumps at an instant, and who lets go or comes to hold for it: motors at their limits, hips,
// feet.

namespace hoplab {

// Where accelerations or torques jump, so does what holds hips and feet; one that begins to move
// bears on the others.
template <class T>
void Robot<T>::Settle(int except, const T& t, T* z) {
  SettleHips(t, z);
  AskCones(except, t, z);
  if (foot_has_inertia_) SettleHips(t, z);
}

// Where rates jump, so does what the motors are told: on which side of its limit each is then is
// part of the event, and a short lag misses the jump (M86).
template <class T>
void Robot<T>::TakeJump(const GuardRef& guard, const std::array<T, kMaxLegs>& told, const T& t,
                        T* z) {
  switch (guard.event) {
    case EventKind::kTouchdown:
    case EventKind::kLiftoff:
    case EventKind::kRollingToToe:
    case EventKind::kToeToRolling:
      FindLimits(Value(t), z);
      for (int i = 0; i < legs_ && lags_shortly_; ++i) MissJump(i, Torque(i, t, z) - told[i], z, z);
      break;
    case EventKind::kStick:
    case EventKind::kHipStop:
      break;
    default:
      return SettleHips(t, z);
  }
  // A foot that has just landed, or come to rest, was asked before the hips had settled.
  Settle(has_dry_hips_ ? -1 : guard.leg, t, z);
}

}  // namespace hoplab
