#pragma once

#include <algorithm>
#include <cmath>

#include "model/mechanisms/legged_body_inl.h"
#include "model/mechanisms/toe_mass_body.h"

// Where modes of a leg with a toe mass begin and end. Of toe_mass_body.cc alone.

namespace hoplab {

// Guards in flight: touch-down (not while the hip rises after a lift-off), apex (not once it was
// passed), fall by height, fall by angle; the ground alone where the hip falls below touch-down
// height, the leg not placed. In stance those of the massless leg.
template <class T>
int ToeMassBody<T>::GuardCount(Mode mode) const {
  if (mode != Mode::kFlight) return body_.GuardCount(mode);
  return FlightGuardCount() + body_.corner_count();
}
template <class T>
int ToeMassBody<T>::FlightGuardCount() const {
  return std::array{4, 2, 3, 1}[static_cast<std::size_t>(flight_)];
}

template <class T>
GuardSpec ToeMassBody<T>::Guard(Mode mode, int i) const {
  if (mode != Mode::kFlight) {
    GuardSpec spec = body_.Guard(mode, i);
    if (spec.event != EventKind::kLiftoff) return spec;
    spec.scale = Value(p_.m) * std::max(Value(p_.g), 1.0);
    spec.if_closed = may_pull_ ? std::nullopt : std::optional(Outcome::kNoSupport);
    return spec;
  }
  if (i >= FlightGuardCount()) return body_.CornerSpec(i - FlightGuardCount());
  const double length = body_.leg().Size();
  switch (FlightEvent(i)) {
    case EventKind::kTouchdown:
      return {EventKind::kTouchdown, length};
    case EventKind::kApex:
      return {EventKind::kApex, 1.0};
    case EventKind::kFallHeight:
      return {EventKind::kFallHeight, length, Outcome::kFellHeight};
    default:
      return {EventKind::kFallAngle, 1.0, Outcome::kFellAngle};
  }
}

template <class T>
void ToeMassBody<T>::Guards(Mode mode, const T& t, const T* z, T* g) const {
  if (mode != Mode::kFlight) {
    const LegLoad<T> load = body_.Load(mode, t, z);
    g[0] = LiftoffGuard(load, t);
    body_.StanceGuards(mode, load, t, z, g);
    return;
  }
  using std::cos;
  const int count = FlightGuardCount();
  for (int i = 0; i < count; ++i) {
    switch (FlightEvent(i)) {
      case EventKind::kTouchdown:
        g[i] = z[kY] - ReachDown(z);
        break;
      case EventKind::kApex:
        g[i] = z[kVy];
        break;
      case EventKind::kFallHeight:
        g[i] = z[kY] - body_.lowest_hip();
        break;
      default:
        g[i] = cos(body_.leg().ChordAngle(LegAngle(z))) - kFallCosine;
    }
  }
  if (body_.corner_count() > 0)
    WithMotionsAt(mode, t, z, [&](const Motions<T>& m) { body_.CornerGuards(m, g + count); });
}

template <class T>
ResetResult ToeMassBody<T>::Reset(Mode mode, int i, const T& t, T* z) {
  const EventKind event = Guard(mode, i).event;
  if (event == EventKind::kCorner) {
    const int own = OwnGuardCount(mode);
    WithMotionsAt(mode, t, z, [&](const Motions<T>& m) { body_.CrossCorner(i - own, m); });
    return {mode};
  }
  const ResetResult result = ResetOwn(mode, i, t, z);
  if (!TraitsOf(event).is_section && !result.end) Seat(result.next, t, z);
  return result;
}

template <class T>
ResetResult ToeMassBody<T>::ResetOwn(Mode mode, int i, const T& t, T* z) {
  switch (Guard(mode, i).event) {
    case EventKind::kTouchdown:
      return TouchDown(t, z);
    case EventKind::kLiftoff:
      return LiftOff(mode, t, z);
    case EventKind::kApex:
      if (flight_ == Flight::kRising) flight_ = Flight::kFalling;
      if (IsTooLow(z)) {
        flight_ = Flight::kLost;
        return {.next = mode, .is_hop = false};
      }
      return {mode};
    case EventKind::kFallHeight:
      return {mode, mode == Mode::kFlight && flight_ == Flight::kLost ? Outcome::kFellNoReturn
                                                                      : Outcome::kFellHeight};
    case EventKind::kFallAngle:
      return {mode, Outcome::kFellAngle};
    default: {
      const ResetResult result = body_.Reset(mode, i, t, z);
      if (result.next != mode) may_pull_ = false;
      return result;
    }
  }
}

template <class T>
EventKind ToeMassBody<T>::FlightEvent(int i) const {
  using enum EventKind;
  static constexpr EventKind kEvents[4][4] = {{kTouchdown, kApex, kFallHeight, kFallAngle},
                                              {kApex, kFallAngle, kSwitch, kSwitch},
                                              {kTouchdown, kFallHeight, kFallAngle, kSwitch},
                                              {kFallHeight, kSwitch, kSwitch, kSwitch}};
  return kEvents[static_cast<int>(flight_)][i];
}

// M45: the chord lifts the toe's weight.
template <class T>
T ToeMassBody<T>::LiftoffGuard(const LegLoad<T>& load, const T& t) const {
  return body_.ChordForce(load, t) * load.y / load.l - p_.m_toe * gravity_y_;
}

// M44: the toe's velocity is lost, the contact is where the leg touches.
template <class T>
ResetResult ToeMassBody<T>::TouchDown(const T& t, T* z) {
  using std::sin;
  const T theta = LegAngle(z);
  const LegLoad<T> load = SwingLoad(t, z);
  const auto& leg = body_.leg();
  const T stretch = load.l / length_ - 1.0;
  const T ahead = stretch * leg.ShownLength(theta) * sin(leg.ChordAngle(theta));
  const ResetResult landed = body_.Land(theta, t, z, ahead);
  for (int i = kToeY; i < kToeStateSize; ++i) z[i] = T(0.0);
  may_pull_ = true;
  const LegLoad<T> now = body_.Load(landed.next, t, z);
  if (Value(LiftoffGuard(now, t)) <= 0.0 && Value(now.damping_rate) >= 0.0)
    return {landed.next, Outcome::kNoSupport};
  return landed;
}

// M46: the toe leaves at rest from where it was held.
template <class T>
ResetResult ToeMassBody<T>::LiftOff(Mode mode, const T& t, T* z) {
  const Vector2<T> toe = HeldToe(mode, t, z);
  if (body_.effects().HasLiftoffVelocity()) body_.ApplyLiftoff(body_.Load(mode, t, z), z);
  z[kToeX] = toe.x;
  z[kToeY] = toe.y;
  z[kToeVx] = z[kToeVy] = T(0.0);
  flight_ = Value(z[kVy]) > 0.0 ? Flight::kRising : IsTooLow(z) ? Flight::kLost : Flight::kFalling;
  swing_->StartSearch(Mode::kToe, nullptr);
  return {Mode::kFlight};
}

}  // namespace hoplab
