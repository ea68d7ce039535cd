#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/mechanisms/legged_body.h"

// Where modes of a legged body begin and end: guards, resets, and where a foot is put down.

namespace hoplab {

template <class T, class LegT>
Mode LeggedBody<T, LegT>::Begin(Mode mode, T* z) {
  sinks_ = Value(z[kVy]) <= 0.0;
  slides_ = 0.0;
  is_lifted_ = false;
  swing_time_ = T(0.0);
  if (foot_has_inertia_) z[FootSpeed()] = T(0.0);
  if (mode != Mode::kFlight) {
    controller_.Enter(Value(z[kVx]));
    if (lagged_) z[kMotorTorque] = CommandedTorque(T(0.0), z);
    mode = PlaceContact(mode, z);
    const bool is_pushed = foot_has_inertia_ && (Pushes(mode, T(0.0), z) ||
                                                 Value(Load(mode, T(0.0), z).damping_rate) > 0.0);
    if (is_pushed && !HoldsWithin(mode, T(0.0), z)) BeginSlide(mode, T(0.0), z);
    MayLift(mode, T(0.0), z);
  }
  Seat(mode, T(0.0), z);
  return mode;
}

// M54: the contact coordinate for which the contact lies where z[kContact] says. First in values,
// by Newton with a difference for a slope, then once in T.
template <class T, class LegT>
Mode LeggedBody<T, LegT>::PlaceContact(Mode mode, T* z) {
  const T place = z[kContact];
  const double alpha = std::atan2(Value(place - z[kX]), Value(z[kY]));
  const auto stand = [&](bool rolling) {
    constexpr double kLeast = 1e-3;  // rad, of a leg that rolls
    const T theta(rolling ? std::max(2.0 * alpha, kLeast) : std::min(alpha, 0.0));
    const Mode landed = leg_->Land(theta, z);
    z[kContact] += place - (z[kX] + Lead(theta));
    return landed;
  };
  const bool has_modes = leg_->OwnGuardCount(Mode::kToe) > 0;
  bool rolls = mode == Mode::kRolling;
  if (mode == Mode::kStance && has_modes) {
    T own[kMaxGuards];
    const Mode toe = stand(false);
    leg_->OwnGuards(toe, Load(toe, T(0.0), z), own);
    rolls = !(Value(own[0]) > 0.0);
  }
  const Mode landed = stand(rolls);
  const auto miss = [&](const T& coordinate) {
    z[kContact] = coordinate;
    return T(z[kX] + Load(landed, T(0.0), z).u - place);
  };
  const double size = leg_->Size(), step = 1e-6 * size;
  double at = Value(z[kContact]), slope = 1.0;
  constexpr int kMostRounds = 30;
  for (int round = 0; round < kMostRounds; ++round) {
    const double off = Value(miss(T(at)));
    slope = (Value(miss(T(at + step))) - Value(miss(T(at - step)))) / (2.0 * step);
    if (!std::isfinite(off) || !std::isfinite(slope) || slope == 0.0) break;
    at -= off / slope;
    if (std::abs(off) < 1e-13 * size) break;
  }
  const T off = miss(T(at));
  z[kContact] = at - (off - Value(off)) / slope;
  return landed;
}

// Guards in flight: touch-down, apex, the ground under a hip whose leg is not placed. Guards in
// stance: lift-off, the leg's own, fall by height, fall by angle, a foot that slips
// away, one that presses again, torque limit. Behind both the corners of formulas. Of two at one
// instant the first fires first.
template <class T, class LegT>
int LeggedBody<T, LegT>::GuardCount(Mode mode) const {
  return OwnGuardCount(mode) + effects_.corner_count();
}
template <class T, class LegT>
int LeggedBody<T, LegT>::OwnGuardCount(Mode mode) const {
  if (mode == Mode::kFlight) return 3;
  return 3 + leg_->OwnGuardCount(mode) + (has_foot_friction_ ? 1 : 0) + (CanLift() ? 1 : 0) +
         (controller_.limited() ? 1 : 0);
}

template <class T, class LegT>
GuardSpec LeggedBody<T, LegT>::Guard(Mode mode, int i) const {
  if (const int corner = i - OwnGuardCount(mode); corner >= 0) return effects_.CornerSpec(corner);
  const double weight = Value(p_.m) * std::max(Value(p_.g), 1.0), length = leg_->Size();
  if (mode == Mode::kFlight) {
    if (i == 0) return {EventKind::kTouchdown, length};
    return i == 1 ? GuardSpec{EventKind::kApex, 1.0} : GuardSpec{EventKind::kFallHeight, length};
  }
  if (i == 0)
    return {EventKind::kLiftoff, liftoff_ == LiftoffRule::kZeroForce ? weight : length,
            may_pull_ ? std::nullopt : std::optional(Outcome::kNoSupport)};
  const int own = leg_->OwnGuardCount(mode);
  if (i <= own) return leg_->OwnGuard(mode, i - 1);
  switch (i - own) {
    case 1:
      return {EventKind::kFallHeight, length, Outcome::kFellHeight};
    case 2:
      return {EventKind::kFallAngle, 1.0, Outcome::kFellAngle};
    case 3:
      if (foot_has_inertia_) {
        if (slides_ != 0.0) return {EventKind::kStick, 1.0};
        return {EventKind::kSlide, weight};
      }
      if (has_foot_friction_) return {EventKind::kLiftoff, 1.0, Outcome::kNoSupport};
      [[fallthrough]];
    case 4:
      if (CanLift()) return {EventKind::kPress, weight};
      [[fallthrough]];
    default:
      return {EventKind::kTorqueLimit, controller_.limit()};
  }
}

/// Guard functions, all crossing zero downward; the table of section 4.
template <class T, class LegT>
void LeggedBody<T, LegT>::Guards(Mode mode, const T& t, const T* z, T* g) const {
  if (mode == Mode::kFlight) {
    const T touchdown = TouchdownHeight(t, z);
    // A leg that a log moves swings through the ground while the hip rises (M51).
    g[0] = sinks_ ? T(z[kY] - touchdown) : T(1.0);
    g[1] = z[kVy];
    g[2] = FallsBelow(touchdown) ? T(z[kY] - y_min_) : T(1.0);
    if (effects_.corner_count() > 0)
      WithMotions(mode, t, z, nullptr, nullptr,
                  [&](const Motions<T>& m) { effects_.CornerGuards(m, g + 3); });
    return;
  }
  const LegLoad<T> load = Load(mode, t, z);
  g[0] =
      liftoff_ == LiftoffRule::kZeroForce ? ChordForce(load, t) : T(leg_->RestChord(load) - load.l);
  StanceGuards(mode, load, t, z, g);
}

template <class T, class LegT>
void LeggedBody<T, LegT>::StanceGuards(Mode mode, const LegLoad<T>& load, const T& t, const T* z,
                                       T* g) const {
  leg_->OwnGuards(mode, load, g + 1);
  g += 1 + leg_->OwnGuardCount(mode);
  g[0] = z[kY] - y_min_;
  g[1] = load.y / load.l - kFallCosine;
  g += 2;
  if (foot_has_inertia_) {  // M87
    *g++ = is_lifted_       ? T(1.0)
           : slides_ != 0.0 ? T(slides_ * z[FootSpeed()])
                            : ConeMargin(mode, load, t, z);
  } else if (has_foot_friction_) {  // M64
    const T slope = load.u / load.y;
    *g++ = 1.0 - p_.law_terms.foot_friction * (Value(slope) < 0.0 ? T(-slope) : slope);
  }
  if (CanLift()) *g++ = is_lifted_ ? PullOfGround(mode, load, t, z) : T(1.0);
  if (controller_.limited()) *g++ = controller_.Guard(z[kVx]);
  if (effects_.corner_count() == 0) return;
  const ChordMotion<T> chord = ChordMotionAt(load, t);
  const HipMotion<T> hip = HipMotionAt(mode, MotorTorque(t, z), load, t, z);
  WithMotions(mode, t, z, &chord, &hip, [&](const Motions<T>& m) { effects_.CornerGuards(m, g); });
}

template <class T, class LegT>
ResetResult LeggedBody<T, LegT>::Reset(Mode mode, int i, const T& t, T* z) {
  if (const int corner = i - OwnGuardCount(mode); corner >= 0) {
    WithMotionsAt(mode, t, z, [&](const Motions<T>& m) { effects_.CrossCorner(corner, m); });
    return {mode};
  }
  const bool is_section = TraitsOf(Guard(mode, i).event).is_section;
  const ResetResult result = ResetOwn(mode, i, t, z);
  if (!is_section && !result.end) Seat(result.next, t, z);
  return result;
}

template <class T, class LegT>
ResetResult LeggedBody<T, LegT>::ResetOwn(Mode mode, int i, const T& t, T* z) {
  const EventKind event = Guard(mode, i).event;
  if (foot_has_inertia_ && mode != Mode::kFlight && i - leg_->OwnGuardCount(mode) == 3) {
    ResetFoot(event, mode, t, z);
    return {mode};
  }
  switch (event) {
    case EventKind::kPress:
      is_lifted_ = false;
      // Friction begins at zero there, whichever way the foot goes.
      if (const double speed = Value(z[FootSpeed()]); speed != 0.0)
        slides_ = speed < 0.0 ? -1.0 : 1.0;
      return {mode};
    case EventKind::kTouchdown:
      return Land(SweptAngle(t, z), t, z, T(0.0));
    case EventKind::kLiftoff:
      if (has_leg_mass_) LeaveWithLeg(Load(mode, t, z), t, z);
      if (effects_.HasLiftoffVelocity()) ApplyLiftoff(Load(mode, t, z), z);
      z[kContact] = T(0.0);
      if (foot_has_inertia_) LetFootGo(z);
      inputs_.Seek(Value(t));
      sinks_ = !inputs_.Has(InputKind::kLegAngle) || Value(z[kVy]) <= 0.0;
      return {Mode::kFlight};
    case EventKind::kApex:
      sinks_ = true;
      return {.next = mode, .is_hop = Value(z[kY] - TouchdownHeight(t, z)) >= 0.0};
    case EventKind::kTorqueLimit:
      controller_.Cross(Value(z[kVx]));
      return {mode};
    case EventKind::kFallHeight:
      return {mode, mode == Mode::kFlight ? Outcome::kFellNoReturn : Outcome::kFellHeight};
    case EventKind::kFallAngle:
      return {mode, Outcome::kFellAngle};
    case EventKind::kFallArc:
      return {mode, Outcome::kFellArc};
    default:
      return {leg_->ResetStance(event, z)};
  }
}

template <class T, class LegT>
ResetResult LeggedBody<T, LegT>::Land(const T& theta, const T& t, T* z, const T& ahead) {
  const Mode stance = leg_->Land(theta, z);
  z[kContact] += ahead;
  ApplyLanding(theta, z);
  controller_.Enter(Value(z[kVx]));
  ++landings_;
  inputs_.Seek(Value(t));
  if (lagged_) z[kMotorTorque] = CommandedTorque(t, z);
  slides_ = 0.0;
  is_lifted_ = false;
  if (has_leg_mass_) {
    TakeLegAlong(Load(stance, t, z), z);
    // The blow changes the speed that the motor follows.
    controller_.Enter(Value(z[kVx]));
    if (lagged_) z[kMotorTorque] = CommandedTorque(t, z);
  }
  // What the leg itself presses brings an unloaded foot into its cone at once; a torque does not.
  if (foot_has_inertia_ && slides_ == 0.0 && Pushes(stance, t, z) && !HoldsWithin(stance, t, z))
    BeginSlide(stance, t, z);
  MayLift(stance, t, z);
  return {stance};
}
template <class T, class LegT>
void LeggedBody<T, LegT>::ApplyLiftoff(const LegLoad<T>& load, T* z) const {
  Vector2<T> velocity{z[kVx], z[kVy]};
  effects_.ChangeLiftoffVelocity({{-load.u / load.l, load.y / load.l}}, velocity);
  z[kVx] = velocity.x;
  z[kVy] = velocity.y;
}

// Whether a hip below touch-down height falls on before it counts as fallen. (A leg that lands
// nearly lying has its hip below y_min there: that is a fall of stance.)
template <class T, class LegT>
bool LeggedBody<T, LegT>::FallsBelow(const T& touchdown) const {
  return Value(y_min_) < Value(touchdown);
}
// What a touch-down at leg angle `theta` does to the velocity.
template <class T, class LegT>
void LeggedBody<T, LegT>::ApplyLanding(const T& theta, T* z) const {
  using std::cos;
  using std::sin;
  const T alpha = leg_->ChordAngle(theta);
  Vector2<T> velocity{z[kVx], z[kVy]};
  effects_.ChangeLandingVelocity({{-sin(alpha), cos(alpha)}, theta}, velocity);
  z[kVx] = velocity.x;
  z[kVy] = velocity.y;
}

}  // namespace hoplab
