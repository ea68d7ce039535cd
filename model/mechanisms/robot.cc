#include "model/mechanisms/robot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/check.h"
#include "model/laws/leg_load.h"
#include "model/mechanisms/robot_bending_inl.h"
#include "model/mechanisms/robot_blows_inl.h"
#include "model/mechanisms/robot_dynamics_inl.h"
#include "model/mechanisms/robot_events_inl.h"
#include "model/mechanisms/robot_feet_inl.h"
#include "model/mechanisms/robot_hips_inl.h"
#include "model/mechanisms/robot_jumps_inl.h"
#include "model/mechanisms/robot_legs_inl.h"
#include "model/mechanisms/robot_motors_inl.h"
#include "model/mechanisms/robot_stances_inl.h"

namespace hoplab {

template <class T>
Robot<T>::Robot(const MechanismSetup<T>& setup)
    : p_(setup.parameters),
      robot_(*p_.robot),
      effects_(setup.effects),
      inputs_(setup.inputs),
      legs_(robot_.legs),
      body_(p_),
      gravity_x_(body_.gravity_x * (1.0 + p_.inertia_x)),
      gravity_y_(body_.gravity_y * (1.0 + p_.inertia_y)),
      has_body_force_(effects_.HasBodyForce() || inputs_.HasForce()),
      has_leg_mass_(!IsZero(robot_.leg_mass)),
      lags_(robot_.control != MotorControl::kLocked &&
            Value(robot_.motor_lag) >= robot_detail::kShortestLag),
      lags_shortly_(!lags_ && robot_.control != MotorControl::kLocked && !IsZero(robot_.motor_lag)),
      creeps_(!IsZero(robot_.foot_slip)),
      drifts_(!IsZero(robot_.stiffness_drift)) {
  // A straight leg's mass is its hub's (M97).
  follows_legs_ =
      !robot_.straight_legs && Value(robot_.leg_mass) >= robot_detail::kLightestLeg * Value(p_.m);
  foot_has_inertia_ = follows_legs_ && HasCone();
  using std::cos;
  using std::sin;
  has_clamp_ = !IsZero(robot_.clamp);
  clamp_ = robot_.clamp / p_.r;
  cos_clamp_ = cos(clamp_);
  sin_clamp_ = sin(clamp_);
  for (int i = 0; i < legs_; ++i) {
    leg_[i].law = RobotLeg<T>(p_, static_cast<std::size_t>(i));
    leg_[i].clock = MotorClock<T>(robot_, i, p_.time_origin);
    gain_[i] = robot_.motor_gain * robot_.gain_of[i];
    has_gain_[i] = !IsZero(T(gain_[i] - 1.0));
    has_zero_[i] = !IsZero(robot_.leg_zero[i]);
    has_bias_[i] = !IsZero(robot_.torque_bias[i]);
    SetUpMotor(i);
  }
  size_ = leg_[0].law.size();
  fall_height_ =
      p_.fall_height == p_.fall_height ? p_.fall_height : robot_detail::kLowestHip * size_;
  ListGuards(Mode::kFlight);
}

template <class T>
void Robot<T>::AgeLegs(const T& t) const {
  if (!drifts_) return;
  const T share = 1.0 + robot_.stiffness_drift * (t + p_.time_origin);
  for (int i = 0; i < legs_; ++i) leg_[i].law.SetStiffness(share);
}

template <class T>
typename Robot<T>::Hip Robot<T>::HipOf(const Frame& frame, int leg, const T* z) const {
  const Vector2<T> at = frame.Turn(robot_.hip_x[leg], robot_.hip_y[leg]);
  const T& turn = z[Pitch() + 1];
  return {at.x,
          at.y,
          z[kVx] - turn * at.y,
          z[kVy] + turn * at.x,
          frame.pitch + z[Angle(leg)],
          turn + z[Rate(leg)]};
}

// M77: a piece of the circle that turns with the hub.
template <class T>
typename Robot<T>::Hip Robot<T>::ClampOf(const Hip& hip) const {
  using std::cos;
  using std::sin;
  if (!has_clamp_) return hip;
  const T s = p_.r * sin(hip.angle), c = p_.r * cos(hip.angle);
  const T x = s - (s * cos_clamp_ + c * sin_clamp_), y = (c * cos_clamp_ - s * sin_clamp_) - c;
  return {hip.x + x,          hip.y + y, hip.vx - hip.rate * y, hip.vy + hip.rate * x,
          hip.angle + clamp_, hip.rate};
}

template <class T>
T Robot<T>::HeightOf(const Leg& leg, const Hip& hip, const T* z) const {
  return z[kY] + hip.y - leg.floor;
}

template <class T>
ClampedPlace<T> Robot<T>::PlaceOf(const Leg& leg, int i, const Hip& of, const T* z) const {
  return PlaceAt(leg, i, ClampOf(of), z);
}

template <class T>
ClampedPlace<T> Robot<T>::PlaceAt(const Leg& leg, int i, const Hip& hip, const T* z) const {
  return {z[Contact(i)] - z[kX] - hip.x,
          HeightOf(leg, hip, z),
          kPi - hip.angle + 2.0 * kPi * leg.turns,
          FootMoves(i) ? T(hip.vx - z[OwnRate(i)]) : hip.vx,
          hip.vy,
          -hip.rate};
}

// Whole turns that bring an angle into (-pi, pi].
template <class T>
int Robot<T>::TurnsOf(double angle) {
  return static_cast<int>(std::ceil((angle - kPi) / (2.0 * kPi)));
}

// M74: how far below its hip the unloaded leg reaches [m].
template <class T>
T Robot<T>::Reach(const T& angle) const {
  return leg_[0].law.Reach(T(angle - 2.0 * kPi * TurnsOf(Value(angle))));
}

// ---- start, discrete state ------------------------------------------------------------

template <class T>
Mode Robot<T>::Begin(Mode, T* z) {
  AgeLegs(T(0.0));
  for (int i = 0; i < legs_; ++i) {
    Leg& leg = leg_[i];
    leg.stance = Stance::kFlight;
    leg.slides = leg.sunk = leg.floor = 0.0;
    leg.turns = 0;
    leg.piece = leg.clock.PieceAt(0.0);
    if (follows_legs_) z[OwnRate(i)] = z[Bent(i)] = T(0.0);
  }
  FindTeeth(z);
  FindLimits(0.0, z);
  for (int i = 0; i < legs_; ++i) {
    if (lags_) z[Given(i)] = Torque(i, T(0.0), z);
    BeginOnFoot(i, z);
  }
  SettleHips(T(0.0), z);
  const Mode mode = ModeNow();
  ListGuards(mode);
  return mode;
}

// Turns, pieces and limits follow from the state; where a contact's root is searched, from the arc
// at rest.
template <class T>
Mode Robot<T>::Resume(std::span<const Foot> feet, T* z) {
  HOPLAB_CHECK(static_cast<int>(feet.size()) == legs_);
  AgeLegs(T(0.0));
  for (int i = 0; i < legs_; ++i) {
    Leg& leg = leg_[i];
    const Foot& foot = feet[static_cast<std::size_t>(i)];
    leg.stance = foot.stance;
    leg.slides = foot.slides;
    leg.piece = leg.clock.PieceAt(0.0);
    const double angle = Value(z[Pitch()] - p_.slope + z[Angle(i)]);
    leg.turns = TurnsOf(angle);
    const double tip = std::max(0.0, 2.0 * kPi * leg.turns - angle);
    if (IsDown(leg)) leg.law.StartAt(leg.stance == Stance::kToe ? tip : 0.0);
  }
  FindTeeth(z);
  FindLimits(0.0, z);
  SettleHips(T(0.0), z);
  const Mode mode = ModeNow();
  ListGuards(mode);
  return mode;
}

template <class T>
void Robot<T>::TellFeet(std::vector<Foot>& feet) const {
  feet.clear();
  for (int i = 0; i < legs_; ++i)
    feet.push_back({leg_[i].stance, static_cast<int>(leg_[i].slides)});
}

template <class T>
void Robot<T>::SaveDiscreteState(DiscreteState& to) const {
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    for (int value : {static_cast<int>(leg.stance), leg.turns, leg.limit, leg.piece, leg.teeth})
      to.Put(value);
    for (double value : {leg.slides, leg.sunk, leg.floor, leg.turns_by}) to.Put(value);
    to.Put(leg.is_held ? 1 : 0);
    leg.law.Save(to);
  }
  inputs_.Save(to);
}
template <class T>
void Robot<T>::LoadDiscreteState(DiscreteState& from) {
  for (int i = 0; i < legs_; ++i) {
    Leg& leg = leg_[i];
    leg.stance = static_cast<Stance>(static_cast<int>(from.Take()));
    for (int* value : {&leg.turns, &leg.limit, &leg.piece, &leg.teeth})
      *value = static_cast<int>(from.Take());
    for (double* value : {&leg.slides, &leg.sunk, &leg.floor, &leg.turns_by}) *value = from.Take();
    leg.is_held = from.Take() != 0.0;
    leg.law.Load(from);
  }
  inputs_.Load(from);
  ListGuards(ModeNow());
}

// A state that did not come out of a run: a leg with a contact coordinate is on the ground there.
template <class T>
void Robot<T>::StartSearch(Mode mode, const double* z) {
  for (int i = 0; i < legs_; ++i) {
    Leg& leg = leg_[i];
    leg.stance = Stance::kFlight;
    leg.slides = 0.0;
    leg.piece = leg.clock.PieceAt(0.0);
    leg.teeth = leg.geared() ? TeethAt(leg, z[Twist(leg)]) : 0;
    leg.is_held = IsDry(i) && z[Rate(i)] == 0.0;
    leg.turns_by = z[Rate(i)] == 0.0 ? 0.0 : z[Rate(i)] > 0.0 ? 1.0 : -1.0;
    if (mode == Mode::kFlight || z[Contact(i)] == 0.0) continue;
    leg.turns = TurnsOf(z[Pitch()] + z[Angle(i)]);
    leg.stance = leg.law.rolls() ? Stance::kRolling : Stance::kToe;
    leg.law.StartAt(0.0);
  }
}

// ---- what it tells ---------------------------------------------------------------------------

template <class T>
std::optional<BallisticFlight<T>> Robot<T>::FreeFlight() const {
  if (IsZero(p_.inertia_x) && IsZero(p_.inertia_y))
    return BallisticFlight<T>{gravity_x_, gravity_y_, T(0.0)};
  // No boom carries the legs.
  const T legs = static_cast<double>(legs_) * robot_.leg_mass;
  return BallisticFlight<T>{(body_.mx * body_.gravity_x + legs * gravity_x_) / (body_.mx + legs),
                            (body_.my * body_.gravity_y + legs * gravity_y_) / (body_.my + legs),
                            T(0.0)};
}

template <class T>
double Robot<T>::FirstStep(Mode mode, const T*) const {
  if (mode == Mode::kFlight) return 1e-3;
  double settles = 0.0;
  for (int i = 0; i < legs_; ++i) settles = std::max(settles, SpeedOf(i).settles);
  return settles > 0.0 ? std::clamp(0.5 / settles, 2e-4, 1e-3) : 2e-4;
}

template <class T>
Observation<T> Robot<T>::Observe(Mode mode, const T& t, const T* z) const {
  AgeLegs(t);
  Observation<T> seen = this->Unseen();
  seen[Channel::kBodyX] = z[kX];
  seen[Channel::kBodyY] = z[kY];
  seen[Channel::kBodyVx] = z[kVx];
  seen[Channel::kBodyVy] = z[kVy];
  seen.robot.emplace();
  for (T& c : *seen.robot) c = T(std::numeric_limits<double>::quiet_NaN());
  seen[Channel::kBodyPitch] = z[Pitch()];
  seen.pitch_rate = z[Pitch() + 1];
  const Frame frame(z[Pitch()] - p_.slope);
  T force_x(0.0), force_y(0.0);
  for (int i = 0; i < legs_; ++i) {
    const Leg& leg = leg_[i];
    const bool down = mode != Mode::kFlight && IsDown(leg);
    seen[OfLeg(Channel::kLegAngle1, i)] = MotorAngle(i, z);
    seen[OfLeg(Channel::kHipTorque1, i)] = Torque(i, t, z);
    seen[OfLeg(Channel::kContact1, i)] = T(down ? 1.0 : 0.0);
    if (!down) continue;
    const Hip hip = HipOf(frame, i, z);
    const ClampedLoad<T> load = leg.law.At(FootOf(leg), PlaceOf(leg, i, hip, z));
    const T fx = load.fx + load.damped_x, fy = load.fy + load.damped_y;
    force_x += fx;
    force_y += fy;
    // X0 is where the arc would begin to be laid down (M81); the contact lies its length on.
    T foot = z[kX] + ClampOf(hip).x + load.lead;
    if (leg.stance == Stance::kRolling) foot += p_.r * load.arc;
    seen[OfLeg(Channel::kLegContactX1, i)] = foot;
    seen[OfLeg(Channel::kLegContactY1, i)] = 0.0 - robot_.ground_compliance * load.fy;
    seen[OfLeg(Channel::kLegArc1, i)] = load.arc;
    seen[OfLeg(Channel::kLegForceX1, i)] = fx;
    seen[OfLeg(Channel::kLegForceY1, i)] = fy;
  }
  seen[Channel::kGroundForceX] = force_x;
  seen[Channel::kGroundForceY] = force_y;
  seen[Channel::kContact] = T(mode == Mode::kFlight ? 0.0 : 1.0);
  return seen;
}

template class Robot<double>;
template class Robot<Jet<1>>;
template class Robot<Jet<kNarrowJet>>;
template class Robot<Jet<kWideJet>>;
template class Robot<Jet<kWidestJet>>;

}  // namespace hoplab
