#pragma once

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "model/laws/leg_load.h"
#include "model/mechanisms/robot_feet_inl.h"
#include "model/mechanisms/robot_motors_inl.h"

// Guards of a robot: what its legs and motors may do next, and how near it is.

namespace hoplab {

namespace robot_detail {
// A leg that has rolled up to this arc has fallen [rad].
inline constexpr double kLeastArc = 0.2;
// A leg that begins deeper below the ground than this cannot stand on it, over its size.
inline constexpr double kDeepest = 0.4;
// A shorter lag of the motors is taken to its first order [s].
inline constexpr double kShortestLag = 1e-5;
// Lighter legs than this, over the body, are rigid on the ground and in the air.
inline constexpr double kLightestLeg = 1e-4;
// A leg that leaves the ground lands where it comes down to it, or, if it has not risen above it,
// as on a lower ground where it sinks this far below where it left, over its size.
inline constexpr double kSunk = 0.01;
// Lowest hip over the legs' size, where nothing else is said.
inline constexpr double kLowestHip = 0.3;
}  // namespace robot_detail

template <class T>
struct Robot<T>::Frame {
  T cos_pitch, sin_pitch, pitch;

  explicit Frame(const T& pitch_over_ground) : pitch(pitch_over_ground) {
    using std::cos;
    using std::sin;
    cos_pitch = cos(pitch);
    sin_pitch = sin(pitch);
  }
  Vector2<T> Turn(const T& x, const T& y) const {
    return {cos_pitch * x - sin_pitch * y, sin_pitch * x + cos_pitch * y};
  }
};

template <class T>
void Robot<T>::ListGuards(Mode mode) {
  guard_count_ = 0;
  const auto add = [this](const GuardRef& guard) { guards_[guard_count_++] = guard; };
  const double weight = Value(p_.m) * std::abs(Value(gravity_y_));
  for (int i = 0; i < legs_; ++i)
    if (!IsDown(leg_[i])) {
      add({EventKind::kTouchdown, i, size_});
      if (follows_legs_) add({EventKind::kTouchdown, i, size_, /*side=*/-1.0});  // it has sunk
    }
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    if (!IsDown(leg)) continue;
    if (leg.slides != 0.0) {
      add({EventKind::kLiftoff, i, weight});
      if (Value(robot_.friction) > 0.0) {
        add({EventKind::kStick, i, 1.0});
        if (!foot_has_inertia_)
          add({EventKind::kLiftoff, i, 1.0, /*side=*/leg.slides});  // it snaps away
      }
    } else if (HasCone()) {
      add({EventKind::kSlide, i, weight, 1});
      add({EventKind::kSlide, i, weight, -1});
      if (foot_has_inertia_) add({EventKind::kLiftoff, i, 1.0});  // it is drawn off
    } else {
      add({EventKind::kLiftoff, i, follows_legs_ ? 1.0 : weight});
    }
    if (leg.stance == Stance::kRolling) {
      add({EventKind::kRollingToToe, i, 1.0});
      add({EventKind::kFallArc, i, 1.0});
    } else if (leg.law.rolls()) {
      add({EventKind::kToeToRolling, i, 1.0});
    }
  }
  for (int i = 0; i < legs_; ++i) add({EventKind::kFallHeight, i, size_});
  if (robot_.control != MotorControl::kLocked && std::isfinite(Value(robot_.torque_limit)))
    for (int i = 0; i < legs_; ++i)
      if (!leg_[i].is_told) add({EventKind::kTorqueLimit, i, Value(robot_.torque_limit)});
  for (int i = 0; i < legs_; ++i)
    if (leg_[i].geared()) add({EventKind::kGearMesh, i, Value(leg_[i].gear.half)});
  for (int i = 0; i < legs_; ++i) {
    if (leg_[i].is_held)
      add({EventKind::kHipSlip, i, Value(robot_.hip_coulomb[i])});
    else if (IsDry(i))
      add({EventKind::kHipStop, i, 1.0});
  }
  if (mode == Mode::kFlight) add({EventKind::kApex, 0, 1.0});
  add({EventKind::kFallPitch, 0, 1.0});
}

template <class T>
Mode Robot<T>::ModeNow() const {
  for (int i = 0; i < legs_; ++i)
    if (IsDown(leg_[i])) return Mode::kStance;
  return Mode::kFlight;
}

template <class T>
int Robot<T>::GuardCount(Mode) const {
  return guard_count_;
}

template <class T>
GuardSpec Robot<T>::Guard(Mode, int i) const {
  const GuardRef& guard = guards_[i];
  // A run that begins fallen ends there.
  std::optional<Outcome> if_closed;
  if (guard.event == EventKind::kFallHeight) if_closed = Outcome::kFellHeight;
  if (guard.event == EventKind::kFallPitch) if_closed = Outcome::kFellPitch;
  return {.event = guard.event,
          .scale = guard.scale,
          .if_closed = if_closed,
          .is_smooth = guard.event == EventKind::kGearMesh || guard.event == EventKind::kHipSlip,
          .leg = guard.leg};
}

// Of each leg: where its hip is, its load and the ground's force if it is down, and what holds its
// hip, if anything may.
template <class T>
struct Robot<T>::Seen {
  std::array<Hip, kMaxLegs> hips;
  std::array<ClampedLoad<T>, kMaxLegs> loads;
  std::array<Vector2<T>, kMaxLegs> ground;
  std::array<T, kMaxLegs> holding;
};

template <class T>
typename Robot<T>::Seen Robot<T>::LookAt(Mode mode, const T& t, const T* z) const {
  const Frame frame(z[Pitch()] - p_.slope);
  Seen seen;
  const bool with_inertia = follows_legs_ && mode != Mode::kFlight;
  if (with_inertia || HoldsHip()) {
    const Forces forces = ForcesOf(frame, t, z);
    seen.loads = forces.load;
    seen.ground = forces.ground;
    seen.holding = forces.holding;
  }
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    seen.hips[i] = HipOf(frame, i, z);
    if (!IsDown(leg) || with_inertia) continue;
    ClampedLoad<T>& load = seen.loads[i];
    load = leg.law.At(FootOf(leg), PlaceOf(leg, i, seen.hips[i], z), false,
                      /*with_slip=*/leg.slides != 0.0);
    seen.ground[i] = {load.fx, load.fy};
  }
  return seen;
}

template <class T>
void Robot<T>::Guards(Mode mode, const T& t, const T* z, T* g) const {
  AgeLegs(t);
  const Seen seen = LookAt(mode, t, z);
  for (int k = 0; k < guard_count_; ++k) g[k] = MarginOf(guards_[k], seen, t, z);
}

template <class T>
T Robot<T>::MarginOf(const GuardRef& guard, const Seen& seen, const T& t, const T* z) const {
  using std::cos;
  const int i = guard.leg;
  const Hip& hip = seen.hips[i];
  const ClampedLoad<T>& load = seen.loads[i];
  const Vector2<T>& ground = seen.ground[i];
  switch (guard.event) {
    case EventKind::kTouchdown:
      return TouchdownMargin(guard, hip, z);
    case EventKind::kLiftoff:
      return LiftoffMargin(guard, hip, load, ground.y, z);
    case EventKind::kSlide:
      return robot_.friction * ground.y + guard.side * ground.x;
    case EventKind::kStick:
      return leg_[i].slides * (foot_has_inertia_ ? z[OwnRate(i)] : load.slip);
    case EventKind::kRollingToToe:
      return leg_[i].law.length() - load.arc;
    case EventKind::kToeToRolling:
      return load.tip;
    case EventKind::kFallArc:
      return load.arc - robot_detail::kLeastArc;
    case EventKind::kFallHeight:
      return z[kY] + hip.y - fall_height_;
    case EventKind::kFallPitch:
      return cos(z[Pitch()]) - std::cos(robot_.pitch_limit);
    case EventKind::kTorqueLimit:
      return TorqueMargin(i, t, z);
    case EventKind::kGearMesh:
      return GearMargin(leg_[i], z);
    case EventKind::kHipStop:
    case EventKind::kHipSlip:
      return HipMargin(i, seen.holding[i], z);
    default:
      return z[kVy];  // apex
  }
}

template <class T>
T Robot<T>::TouchdownMargin(const GuardRef& guard, const Hip& hip, const T* z) const {
  T over = z[kY] + hip.y - Reach(hip.angle);
  if (Bends(guard.leg)) over += HeldUp(guard.leg, hip.angle, z);
  return guard.side == 0.0 ? over : T(over - SunkLevel(leg_[guard.leg]));
}

template <class T>
double Robot<T>::SunkLevel(const Leg& leg) const {
  return leg.sunk - robot_detail::kSunk * size_;
}

template <class T>
T Robot<T>::LiftoffMargin(const GuardRef& guard, const Hip& hip, const ClampedLoad<T>& load,
                          const T& press, const T* z) const {
  if (guard.side != 0.0) return load.yield - kLeastYield;
  if (follows_legs_ && leg_[guard.leg].slides == 0.0)
    return DrawnOff(leg_[guard.leg], hip, press, z);
  return press;
}

// A foot that holds from its blow on and never comes to press (M92) is drawn off where its hip is
// higher than its leg reaches.
template <class T>
T Robot<T>::DrawnOff(const Leg& leg, const Hip& hip, const T& press, const T* z) const {
  const T pressed = press / (p_.m * std::max(std::abs(Value(gravity_y_)), 1e-9));
  const T below = (Reach(hip.angle) - HeightOf(leg, hip, z)) / size_;
  return Value(pressed) > Value(below) ? pressed : below;
}

}  // namespace hoplab
