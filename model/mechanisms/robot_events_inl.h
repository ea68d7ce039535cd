#pragma once

#include "model/mechanisms/robot_guards_inl.h"

// Resets of a robot: what an event does to it.

namespace hoplab {

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
  z[Contact(i)] += ahead_[i];
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

// The state after an event; the outcome, where the run ends by it, and what it turned out to be.
template <class T>
std::optional<Outcome> Robot<T>::Happens(const GuardRef& guard, const T& t, T* z,
                                         std::optional<EventKind>& turned_out) {
  Leg& leg = leg_[guard.leg];
  switch (guard.event) {
    case EventKind::kTouchdown: {
      if (guard.side != 0.0) leg.floor = SunkLevel(leg);
      const std::optional<Outcome> end = Land(guard.leg, t, z);
      if (!IsDown(leg)) turned_out = EventKind::kBrush;
      return end;
    }
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
      return Outcome::kFellArc;
    case EventKind::kFallHeight:
      return Outcome::kFellHeight;
    case EventKind::kFallPitch:
      return Outcome::kFellPitch;
    default:
      break;  // apex
  }
  return std::nullopt;
}

template <class T>
ResetResult Robot<T>::Reset(Mode, int i, const T& t, T* z) {
  AgeLegs(t);
  const GuardRef guard = guards_[i];
  std::array<T, kMaxLegs> told;
  for (int k = 0; k < legs_; ++k) told[k] = Torque(k, t, z);
  std::optional<EventKind> turned_out;
  const std::optional<Outcome> end = Happens(guard, t, z, turned_out);
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
