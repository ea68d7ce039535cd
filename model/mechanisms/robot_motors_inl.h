#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/mechanisms/robot_feet_inl.h"

// What a robot's motors are told, what they give (M75, M76, M95), and what their gears pass on
// (M96).

namespace hoplab {

template <class T>
struct Robot<T>::Reference {
  T angle, rate;  // [rad], [rad/s]
};

template <class T>
void Robot<T>::SetUpMotor(int i) {
  Leg& leg = leg_[i];
  leg.is_told =
      robot_.control == MotorControl::kRecorded && !inputs_.Has(OfMotor(InputKind::kLegAngle1, i));
  hub_[i] = robot_.rotor_inertia;
  rubs_[i] = robot_.control != MotorControl::kLocked &&
             (!IsZero(robot_.hip_viscous[i]) || !IsZero(robot_.hip_coulomb[i]));
  has_dry_hips_ = has_dry_hips_ || IsDry(i);
  if (!Gear<T>::HasPlay(robot_, i) || robot_.control == MotorControl::kLocked) return;
  leg.gear_place = gears_++;
  leg.gear = Gear<T>(robot_, i);
  hub_[i] = robot_.hub_share[i] * robot_.rotor_inertia;
}

template <class T>
T Robot<T>::MotorAngle(int leg, const T* z) const {
  const Leg& own = leg_[leg];
  T angle = z[Angle(leg)];
  if (has_zero_[leg]) angle -= robot_.leg_zero[leg];
  if (own.geared()) angle += z[Twist(own)];
  return angle;
}
template <class T>
T Robot<T>::MotorRate(int leg, const T* z) const {
  const Leg& own = leg_[leg];
  return own.geared() ? z[RotorRate(own)] : z[Rate(leg)];
}

template <class T>
typename Robot<T>::Reference Robot<T>::ReferenceOf(int leg, const T& t) const {
  const Leg& own = leg_[leg];
  if (robot_.control == MotorControl::kClock)
    return {own.clock.Angle(own.piece, t), own.clock.Rate(own.piece)};
  if (robot_.control == MotorControl::kRecorded) {
    const InputSignal<T>& angle = inputs_.of(OfMotor(InputKind::kLegAngle1, leg));
    return {angle.At(t), angle.Rate()};
  }
  return {robot_.angle[leg], T(0.0)};
}

// M75: what the motor is told to give, before its limit [N m]; M95 where that was recorded.
template <class T>
T Robot<T>::Command(int leg, const T& t, const T* z) const {
  if (leg_[leg].is_told) return inputs_.At(OfMotor(InputKind::kHipTorque1, leg), t);
  const Reference to = ReferenceOf(leg, t);
  return robot_.motor_kp * (to.angle - MotorAngle(leg, z)) +
         robot_.motor_kd * (to.rate - MotorRate(leg, z));
}

template <class T>
T Robot<T>::Torque(int leg, const T& t, const T* z) const {
  if (robot_.control == MotorControl::kLocked) return T(0.0);
  const double side = leg_[leg].limit;
  return side == 0.0 ? Command(leg, t, z) : side * robot_.torque_limit;
}

// How fast what the motor is told changes within its piece, off its limit [N m/s].
template <class T>
T Robot<T>::ToldRate(int leg, const T* z, const T* dz) const {
  const Leg& own = leg_[leg];
  if (own.is_told) return inputs_.of(OfMotor(InputKind::kHipTorque1, leg)).Rate();
  const T& turned = own.geared() ? dz[RotorRate(own)] : dz[Rate(leg)];
  return robot_.motor_kp * (ReferenceOf(leg, T(0.0)).rate - MotorRate(leg, z)) -
         robot_.motor_kd * turned;
}

// A start gives the body's motion, and the pitch and its rate; motors begin on their reference, or
// where it is told, by their encoders (M100). A gear begins in the middle of its play, its rotor as
// fast as its hip.
template <class T>
void Robot<T>::CompleteStart(T* z, int given) const {
  const bool leans = robot_.starts_leaning && given == Contact(0);
  const bool own = given > 6 && !leans, clock = robot_.control == MotorControl::kClock;
  const bool recorded = robot_.control == MotorControl::kRecorded;
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    ahead_[i] = leans ? z[Angle(i)] : T(0.0);
    const T turned = leans ? z[Rate(i)] : T(0.0);
    if (!own) {
      z[Angle(i)] = robot_.angle[i];
      z[Rate(i)] = recorded ? robot_.rate[i] : T(0.0);
      if (clock) {
        const int piece = leg.clock.PieceAt(0.0);
        z[Angle(i)] = leg.clock.Angle(piece, T(0.0));
        z[Rate(i)] = leg.clock.Rate(piece);
      } else if (recorded && !leg.is_told && !robot_.starts_at_angles) {
        const Reference to = ReferenceOf(i, T(0.0));
        z[Angle(i)] = to.angle;
        z[Rate(i)] = to.rate;
      }
      z[Angle(i)] += robot_.leg_zero[i];
      z[Angle(i)] += turned;
    }
    if (leg.geared() && given <= Twist(leg)) z[RotorRate(leg)] = z[Rate(i)];
  }
}

template <class T>
void Robot<T>::FindLimit(int leg, double t, const T* z) {
  leg_[leg].limit = 0;
  if (leg_[leg].is_told) return;  // what was recorded was limited before
  const double command = Value(Command(leg, T(t), z));
  if (std::abs(command) > Value(robot_.torque_limit)) leg_[leg].limit = command > 0.0 ? 1 : -1;
}
template <class T>
void Robot<T>::FindLimits(double t, const T* z) {
  for (int i = 0; i < legs_; ++i) FindLimit(i, t, z);
}

template <class T>
double Robot<T>::NextKnot(Mode mode) const {
  double next = inputs_.NextKnot(mode == Mode::kFlight);
  if (robot_.control != MotorControl::kClock) return next;
  for (int i = 0; i < legs_; ++i) next = std::min(next, Value(leg_[i].clock.End(leg_[i].piece)));
  return next;
}

template <class T>
std::optional<T> Robot<T>::PassKnot(Mode mode, double t, T* z) {
  AgeLegs(T(t));
  const std::optional<InputKind> kind = inputs_.Due(mode == Mode::kFlight, t);
  if (!kind && robot_.control != MotorControl::kClock) return std::nullopt;
  int motor = kind ? MotorOf(*kind) : 0;
  if (!kind)
    for (int i = 1; i < legs_; ++i)
      if (leg_[i].clock.End(leg_[i].piece) < leg_[motor].clock.End(leg_[motor].piece)) motor = i;
  const T instant = kind ? inputs_.of(*kind).KnotTime() : leg_[motor].clock.End(leg_[motor].piece);
  // Where a short lag misses a jump (M86) it does so at the knot's own instant.
  const bool misses = motor >= 0 && lags_shortly_;
  T at[kMaxStates];
  if (misses) MoveAlong(mode, t, instant - Value(instant), z, at);
  const T before = misses ? Torque(motor, instant, at) : T(0.0);
  if (kind)
    inputs_.Pass(mode == Mode::kFlight, t);
  else
    ++leg_[motor].piece;
  // A reference's rate jumps at each of its rows, and the command with it: on which side of its
  // limit that is then is part of the knot.
  if (motor >= 0) FindLimit(motor, t, z);
  if (misses) MissJump(motor, Torque(motor, instant, at) - before, at, z);
  const bool jumps = !kind || inputs_.of(*kind).held() || (motor >= 0 && !leg_[motor].is_told);
  if (jumps) Settle(/*except=*/-1, T(t), z);
  ListGuards(mode);
  return instant;
}

// The state a variation of time later.
template <class T>
void Robot<T>::MoveAlong(Mode mode, double t, const T& by, const T* z, T* to) const {
  T rate[kMaxStates];
  Derivative(mode, T(t), z, rate);
  for (int i = 0; i < size(); ++i) to[i] = z[i] + Value(rate[i]) * by;
}

// Motors that rest on their reference, and legs that do not ring, do not steer the step, and what
// is to be differentiated may still excite them: no further than twice the time in which they swing
// by a radian and 2.5 times that in which they fall to 1/e. There a step of DOP853 is off by 4e-5
// and 7e-6 of what swings and falls. A run without directions keeps to that, too: beyond, its
// motors would be as far from rest as the tolerance lets them, which is noise in differences of
// runs.
template <class T>
double Robot<T>::LongestStep(Mode, const T& t, const T*) const {
  AgeLegs(t);
  double swings = 0.0, settles = 0.0;  // the fastest [1/s]
  for (int i = 0; i < legs_; ++i) {
    if (!Bends(i)) continue;
    // Its hub gives way to it.
    const LegBending& mode = FirstBending();
    const double mass = Value(robot_.leg_mass), r = Value(p_.r),
                 J = Value(hub_[i]) / (mass * r * r);
    const double firm =
        robot_.control == MotorControl::kLocked ? 1.0 : 1.0 - mode.about * mode.about / (2.0 + J);
    const double square = Value(leg_[i].law.bending_stiffness()) / (mass * firm);
    swings = std::max(swings, std::sqrt(square));
    settles = std::max(settles, square * Value(leg_[i].law.tau()));
  }
  for (int i = 0; i < legs_; ++i) {
    const MotorSpeed motor = SpeedOf(i);
    swings = std::max(swings, motor.swings);
    settles = std::max(settles, motor.settles);
    if (rubs_[i]) settles = std::max(settles, Value(robot_.hip_viscous[i]) / Value(hub_[i]));
  }
  if (lags_) settles = std::max(settles, 1.0 / Value(robot_.motor_lag));
  return std::min(2.0 / swings, 2.5 / settles);
}

// Of a motor that follows what it is told; 0 where that is a torque.
template <class T>
typename Robot<T>::MotorSpeed Robot<T>::SpeedOf(int i) const {
  if (leg_[i].is_told || robot_.control == MotorControl::kLocked) return {0.0, 0.0};
  const double turned = Value(robot_.rotor_inertia) - (leg_[i].geared() ? Value(hub_[i]) : 0.0);
  const double gives = std::max(0.0, Value(gain_[i])) / turned;
  return {std::sqrt(gives * Value(robot_.motor_kp)), gives * Value(robot_.motor_kd)};
}

// An error of the rate of what a motor turns moves it by that over the motor's speed, and no
// further. A motor that lags swings where it would settle. A leg's own motion swings, too.
template <class T>
double Robot<T>::ErrorUnit(int i) const {
  AgeLegs(T(0.0));
  for (int leg = 0; leg < legs_; ++leg) {
    const Leg& own = leg_[leg];
    if (follows_legs_ && i == OwnRate(leg))
      return std::sqrt(Value(own.law.bending_stiffness()) / Value(robot_.leg_mass));
    if (i != (own.geared() ? RotorRate(own) : Rate(leg))) continue;
    MotorSpeed speed = SpeedOf(leg);
    if (lags_) {
      const double lag = Value(robot_.motor_lag);
      speed.swings = std::min(speed.swings, std::cbrt(speed.swings * speed.swings / lag));
      speed.settles = std::min(speed.settles, std::sqrt(speed.settles / lag));
    }
    return std::max({1.0, speed.swings, speed.settles});
  }
  return 1.0;
}

// Below zero where the motor meets its limit, or, beyond it, where it comes back.
template <class T>
T Robot<T>::TorqueMargin(int i, const T& t, const T* z) const {
  const T command = Command(i, t, z);
  const double side = leg_[i].limit;
  if (side != 0.0) return side * command - robot_.torque_limit;
  return robot_.torque_limit - (Value(command) < 0.0 ? T(-command) : command);
}

// ---- gears (M96) -----------------------------------------------------------------------------

// Which of its teeth are pressed at a twist.
template <class T>
int Robot<T>::TeethAt(const Leg& leg, double twist) {
  if (std::abs(twist) <= Value(leg.gear.half)) return 0;
  return twist > 0.0 ? 1 : -1;
}
template <class T>
void Robot<T>::FindTeeth(const T* z) {
  for (int i = 0; i < legs_; ++i)
    if (leg_[i].geared()) leg_[i].teeth = TeethAt(leg_[i], Value(z[Twist(leg_[i])]));
}
// Below zero where teeth meet, or, once they touch, where they part.
template <class T>
T Robot<T>::GearMargin(const Leg& leg, const T* z) const {
  const T& twist = z[Twist(leg)];
  if (leg.teeth != 0) return leg.gear.Press(leg.teeth, twist);
  return -leg.gear.Press(Value(twist) < 0.0 ? -1 : 1, twist);
}
template <class T>
T Robot<T>::GearTorque(const Leg& leg, int i, const T* z) const {
  return leg.gear.Torque(leg.teeth, z[Twist(leg)], z[RotorRate(leg)] - z[Rate(i)]);
}

}  // namespace hoplab
