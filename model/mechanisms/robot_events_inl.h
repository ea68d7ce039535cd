#pragma once

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "model/laws/leg_load.h"
#include "model/mechanisms/robot_feet_inl.h"
#include "model/mechanisms/robot_motors_inl.h"

// Guards and resets of a robot: what its legs and motors do next.

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

template <class T>
void Robot<T>::Guards(Mode mode, const T& t, const T* z, T* g) const {
  using std::cos;
  const Frame frame(z[Pitch()] - p_.slope);
  std::array<Hip, kMaxLegs> hips;
  std::array<ClampedLoad<T>, kMaxLegs> loads;
  std::array<Vector2<T>, kMaxLegs> ground;
  std::array<T, kMaxLegs> holding;
  const bool with_inertia = follows_legs_ && mode != Mode::kFlight;
  if (with_inertia || HoldsHip()) {
    const Forces forces = ForcesOf(frame, t, z);
    loads = forces.load;
    ground = forces.ground;
    holding = forces.holding;
  }
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    hips[i] = HipOf(frame, i, z);
    if (!IsDown(leg) || with_inertia) continue;
    loads[i] = leg.law.At(FootOf(leg), PlaceOf(leg, i, hips[i], z), false,
                          /*with_slip=*/leg.slides != 0.0);
    ground[i] = {loads[i].fx, loads[i].fy};
  }
  for (int k = 0; k < guard_count_; ++k) {
    const GuardRef& guard = guards_[k];
    const int i = guard.leg;
    const Hip& hip = hips[i];
    const ClampedLoad<T>& load = loads[i];
    switch (guard.event) {
      case EventKind::kTouchdown:
        g[k] = TouchdownMargin(guard, hip, z);
        break;
      case EventKind::kLiftoff:
        g[k] = LiftoffMargin(guard, hip, load, ground[i].y, z);
        break;
      case EventKind::kSlide:
        g[k] = robot_.friction * ground[i].y + guard.side * ground[i].x;
        break;
      case EventKind::kStick:
        g[k] = leg_[i].slides * (foot_has_inertia_ ? z[OwnRate(i)] : load.slip);
        break;
      case EventKind::kRollingToToe:
        g[k] = leg_[i].law.length() - load.arc;
        break;
      case EventKind::kToeToRolling:
        g[k] = load.tip;
        break;
      case EventKind::kFallArc:
        g[k] = load.arc - robot_detail::kLeastArc;
        break;
      case EventKind::kFallHeight:
        g[k] = z[kY] + hip.y - fall_height_;
        break;
      case EventKind::kFallPitch:
        g[k] = cos(z[Pitch()]) - std::cos(robot_.pitch_limit);
        break;
      case EventKind::kTorqueLimit:
        g[k] = TorqueMargin(i, t, z);
        break;
      case EventKind::kGearMesh:
        g[k] = GearMargin(leg_[i], z);
        break;
      case EventKind::kHipStop:
      case EventKind::kHipSlip:
        g[k] = HipMargin(i, holding[i], z);
        break;
      default:
        g[k] = z[kVy];  // apex
    }
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

// M74: the leg lands with the part of it that is lowest.
template <class T>
std::optional<Outcome> Robot<T>::Land(int i, const T& t, T* z, bool comes_down) {
  const Frame frame(z[Pitch()] - p_.slope);
  Leg& leg = leg_[i];
  const Hip hip = HipOf(frame, i, z);
  leg.turns = TurnsOf(Value(hip.angle));
  const ClampedLanding<T> as = leg.law.LandsAs(T(hip.angle - 2.0 * kPi * leg.turns));
  z[Contact(i)] = z[kX] + hip.x + as.lead;
  z[Contact(i)] -= as.laid;
  if (follows_legs_) TakeBendAlong(i, hip.angle, z);
  leg.stance = as.rolling ? Stance::kRolling : Stance::kToe;
  leg.law.StartAt(as.tip);
  leg.slides = 0.0;
  if (comes_down && follows_legs_) {
    Blow(i, z);
    FindLimits(Value(t), z);
  }
  if (foot_has_inertia_ && comes_down && leg.slides == 0.0) SlideOutsideCone(i, 0.0, t, z);
  if (follows_legs_ && comes_down) GoOnIfBrushed(i, t, z);
  if (follows_legs_ || !IsDown(leg)) return std::nullopt;
  // The point of contact moves with the leg, that bends only from here on.
  const Hip after = HipOf(frame, i, z);
  const double u = Value(as.lead), height = Value(Reach(hip.angle)), spin = Value(after.rate);
  const double vx = Value(after.vx) + spin * height, vy = Value(after.vy) + spin * u;
  leg.slides = leg.law.SlidesAtLanding(as.tip, as.base, vx, vy);
  if (leg.slides == 0.0 && !leg.law.PressesAtLanding(as.tip, as.base, vx, vy))
    return Outcome::kNoSupport;
  return std::nullopt;
}

// A leg that reaches below the ground where the run begins stands on it: as if it had landed
// straight above and been pressed down (M78). One that cannot stand so is left in the ground.
template <class T>
void Robot<T>::BeginOnFoot(int i, T* z) {
  Leg& leg = leg_[i];
  const Hip hip = HipOf(Frame(z[Pitch()] - p_.slope), i, z);
  const double depth = Value(Reach(hip.angle)) - Value(z[kY] + hip.y);
  if (!(depth > kAtZero * size_) || depth > robot_detail::kDeepest * size_) return;
  Land(i, T(0.0), z, /*comes_down=*/false);
  leg.slides = 0.0;
  const double mu = Value(robot_.friction);
  ClampedLoad<T> load = leg.law.At(FootOf(leg), PlaceOf(leg, i, hip, z), false);
  if (!(std::abs(Value(load.fx)) <= mu * Value(load.fy))) {
    leg.slides = Value(load.fx) > 0.0 ? -1.0 : 1.0;
    leg.law.Restart();
    load = leg.law.At(FootOf(leg), PlaceOf(leg, i, hip, z), false);
  }
  if (!(Value(load.fy) > 0.0)) LiftOff(i, z);
}

template <class T>
ResetResult Robot<T>::Reset(Mode, int i, const T& t, T* z) {
  const GuardRef guard = guards_[i];
  Leg& leg = leg_[guard.leg];
  std::optional<Outcome> end;
  std::optional<EventKind> turned_out;
  std::array<T, kMaxLegs> told;
  for (int k = 0; k < legs_; ++k) told[k] = Torque(k, t, z);
  switch (guard.event) {
    case EventKind::kTouchdown:
      if (guard.side != 0.0) leg.floor = SunkLevel(leg);
      end = Land(guard.leg, t, z);
      if (!IsDown(leg)) turned_out = EventKind::kBrush;
      break;
    case EventKind::kLiftoff:
      if (follows_legs_) SpringOff(guard.leg, z);
      LiftOff(guard.leg, z);
      break;
    case EventKind::kRollingToToe:
      RollOnto(guard.leg, Stance::kToe, z);
      break;
    case EventKind::kToeToRolling:
      RollOnto(guard.leg, Stance::kRolling, z);
      break;
    case EventKind::kSlide:
      SlideAway(guard, z);
      break;
    case EventKind::kStick:
      HoldFoot(guard.leg, t, z);
      break;
    case EventKind::kTorqueLimit:
      leg.limit = leg.limit != 0 ? 0 : Value(Command(guard.leg, t, z)) > 0.0 ? 1 : -1;
      break;
    case EventKind::kGearMesh:
      leg.teeth = leg.teeth != 0 ? 0 : Value(z[Twist(leg)]) > 0.0 ? 1 : -1;
      break;
    case EventKind::kHipStop:
      z[Rate(guard.leg)] = T(0.0);
      break;
    case EventKind::kHipSlip: {
      const Forces forces = ForcesOf(Frame(z[Pitch()] - p_.slope), t, z);
      TurnHip(guard.leg, forces.holding[guard.leg]);
      break;
    }
    case EventKind::kFallArc:
      end = Outcome::kFellArc;
      break;
    case EventKind::kFallHeight:
      end = Outcome::kFellHeight;
      break;
    case EventKind::kFallPitch:
      end = Outcome::kFellPitch;
      break;
    default:
      break;  // apex
  }
  const bool goes_on = guard.event == EventKind::kHipSlip || TraitsOf(guard.event).is_section;
  if (!end && !goes_on) {
    if (follows_legs_)
      TakeJump(guard, told, t, z);
    else
      SettleHips(t, z);
  }
  const Mode mode = ModeNow();
  ListGuards(mode);
  return {.next = mode, .end = end, .turned_out = turned_out};
}

}  // namespace hoplab
