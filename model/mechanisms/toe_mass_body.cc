#include "model/mechanisms/toe_mass_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/mechanisms/legged_body_inl.h"
#include "model/mechanisms/toe_mass_events_inl.h"

namespace hoplab {

template <class T>
ToeMassBody<T>::ToeMassBody(const MechanismSetup<T>& setup)
    : p_(setup.parameters),
      body_(setup),
      extended_(p_.law_terms.active),
      // Nothing tells hip and toe apart while a relaxed leg falls.
      falls_freely_(!setup.effects.HasBodyForce() && !setup.effects.HasHipTorque() &&
                    !setup.effects.HasJointTorque() && !setup.effects.HasChordFormula() &&
                    !setup.effects.TouchdownAngleFalls() && IsZero(p_.inertia_x) &&
                    IsZero(p_.inertia_y) &&
                    (IsZero(p_.slope) || !setup.effects.HasTouchdownAngle())),
      gravity_x_(-body_.inertia().weight_along / p_.m),
      gravity_y_(-body_.inertia().weight_down / p_.m) {
  LegLawOf(setup.law).Make(InTheAir(p_), swing_);
  swing_->StartSearch(Mode::kToe, nullptr);
  const T upright[] = {T(0.0), T(1.0), T(0.0), T(0.0), T(0.0)};
  length_ = swing_->RestChord(swing_->Load(Mode::kToe, upright));
}

template <class T>
void ToeMassBody<T>::SaveDiscreteState(DiscreteState& to) const {
  body_.SaveDiscreteState(to);
  swing_->SaveDiscreteState(to);
  to.Put(static_cast<int>(flight_));
  to.Put(may_pull_);
}
template <class T>
void ToeMassBody<T>::LoadDiscreteState(DiscreteState& from) {
  body_.LoadDiscreteState(from);
  swing_->LoadDiscreteState(from);
  flight_ = static_cast<Flight>(static_cast<int>(from.Take()));
  may_pull_ = from.Take() != 0.0;
}

template <class T>
Mode ToeMassBody<T>::Begin(Mode mode, T* z) {
  Seat(mode, T(0.0), z);
  return mode;
}

template <class T>
template <class Act>
void ToeMassBody<T>::WithMotionsAt(Mode mode, const T& t, const T* z, const Act& act) const {
  if (mode != Mode::kFlight) return body_.WithMotionsAt(mode, t, z, act);
  const Swing s = SwingAt(t, z);
  const ChordMotion<T> chord = body_.ChordMotionAt(s.load, t);
  body_.WithMotions(mode, t, z, &chord, &s.hip, act);
}
template <class T>
void ToeMassBody<T>::Seat(Mode mode, const T& t, const T* z) {
  if (body_.corner_count() == 0) return;
  WithMotionsAt(mode, t, z, [&](const Motions<T>& m) { body_.SeatCorners(m); });
}

template <class T>
void ToeMassBody<T>::StartSearch(Mode mode, const double* z) {
  if (mode != Mode::kFlight) body_.StartSearch(mode, z);
}

template <class T>
void ToeMassBody<T>::CompleteStart(T* z, int given) const {
  if (given >= kToeStateSize) return;
  using std::cos;
  using std::sin;
  const T theta = body_.TouchdownAngle(z);
  z[kToeX] = z[kX] + length_ * sin(theta);
  z[kToeY] = z[kY] - length_ * cos(theta);
  z[kToeVx] = z[kVx];
  z[kToeVy] = z[kVy];
}

template <class T>
void ToeMassBody<T>::Derivative(Mode mode, const T& t, const T* z, T* dz) const {
  if (mode != Mode::kFlight) {
    body_.Derivative(mode, t, z, dz);
    for (int i = kToeY; i < kToeStateSize; ++i) dz[i] = T(0.0);
    return;
  }
  const Swing s = SwingAt(t, z);
  Vector2<T> on_hip = s.force;
  if (body_.effects().HasBodyForce()) {
    const Vector2<T> more = body_.BodyForce(mode, t, z);
    on_hip.x += more.x;
    on_hip.y += more.y;
  }
  const Inertia<T>& inertia = body_.inertia();
  dz[kX] = z[kVx];
  dz[kY] = z[kVy];
  dz[kVx] = on_hip.x / inertia.mx + inertia.gravity_x;  // M40
  dz[kVy] = on_hip.y / inertia.my + inertia.gravity_y;
  dz[kToeX] = z[kToeVx];
  dz[kToeY] = z[kToeVy];
  dz[kToeVx] = gravity_x_ - s.force.x / p_.m_toe;
  dz[kToeVy] = gravity_y_ - s.force.y / p_.m_toe;
}

template <class T>
bool ToeMassBody<T>::IsBallistic(Mode mode) const {
  return mode == Mode::kFlight && flight_ == Flight::kFirst && falls_freely_;
}

template <class T>
BallisticFlight<T> ToeMassBody<T>::Ballistic(const T* z) const {
  return {.ax = gravity_x_,
          .ay = gravity_y_,
          .contact_height = body_.TouchdownHeight(z),
          .is_pair = true};
}

template <class T>
double ToeMassBody<T>::FirstStep(Mode mode, const T* z) const {
  if (mode != Mode::kFlight) return body_.FirstStep(mode, z);
  const double toe = Value(p_.m_toe) * Value(p_.m) / (Value(p_.m_toe) + Value(p_.m));
  const LegLoad<T> load = SwingLoad(T(0.0), z);
  double step = std::min(0.01, 0.1 * std::sqrt(toe / Value(body_.leg().Stiffness(load))));
  if (Value(p_.d) > 0.0) step = std::min(step, 0.1 * toe / Value(p_.d));
  return step;
}

template <class T>
double ToeMassBody<T>::LongestStep(Mode mode, const T& t, const T* z) const {
  if (kJetWidth<T> == 0 || mode != Mode::kFlight || flight_ != Flight::kFirst)
    return std::numeric_limits<double>::infinity();
  constexpr double kSmall = 1e-6;  // m, m/s
  T rest[kToeStateSize], answer[kToeStateSize], moved[kToeStateSize];
  Derivative(mode, t, z, rest);
  double rate = 0.0;
  for (int i = kToeX; i < kToeStateSize; ++i) {
    std::copy_n(z, kToeStateSize, moved);
    moved[i] += kSmall;
    Derivative(mode, t, moved, answer);
    const double change =
        std::hypot(Value(answer[kToeVx] - rest[kToeVx]), Value(answer[kToeVy] - rest[kToeVy])) /
        kSmall;
    rate = std::max(rate, i < kToeVx ? std::sqrt(change) : change);
  }
  return 1.0 / rate;
}

template <class T>
Observation<T> ToeMassBody<T>::Observe(Mode mode, const T& t, const T* z) const {
  if (mode != Mode::kFlight) {
    Observation<T> seen = body_.Observe(mode, t, z);
    seen[Channel::kGroundForceX] -= p_.m_toe * gravity_x_;
    seen[Channel::kGroundForceY] -= p_.m_toe * gravity_y_;
    return seen;
  }
  const Swing s = SwingAt(t, z);
  Observation<T> seen = this->Unseen();
  seen[Channel::kBodyX] = z[kX];
  seen[Channel::kBodyY] = z[kY];
  seen[Channel::kBodyVx] = z[kVx];
  seen[Channel::kBodyVy] = z[kVy];
  seen[Channel::kLegAngle] = s.theta;
  seen[Channel::kLegLength] = body_.leg().ShownLength(s.theta) * s.load.l / length_;
  seen[Channel::kGroundForceX] = seen[Channel::kGroundForceY] = T(0.0);
  seen[Channel::kHipTorque] = s.torque;
  seen[Channel::kContact] = T(0.0);
  return seen;
}

template <class T>
T ToeMassBody<T>::Energy(Mode mode, const T* z) const {
  if (mode != Mode::kFlight) {
    const Vector2<T> toe = HeldToe(mode, T(0.0), z);
    return body_.Energy(mode, z) - p_.m_toe * (gravity_x_ * toe.x + gravity_y_ * toe.y);
  }
  const LegLoad<T> load = SwingLoad(T(0.0), z);
  const T strain = extended_ ? swing_->extended().StrainEnergy(Mode::kToe, load, {T(0.0), T(0.0)})
                             : swing_->StrainEnergy(load);
  const T moving = 0.5 * (z[kToeVx] * z[kToeVx] + z[kToeVy] * z[kToeVy]);
  return body_.inertia().Energy(z) + strain +
         p_.m_toe * (moving - gravity_x_ * z[kToeX] - gravity_y_ * z[kToeY]);
}

// The leg off the ground: nothing to sink into, to creep on or to bend it by a torque of stance.
template <class T>
Parameters<T> ToeMassBody<T>::InTheAir(Parameters<T> p) {
  p.law_terms.ground_compliance = p.law_terms.foot_slip = p.law_terms.torque_bending = T(0.0);
  p.law_terms.torque_active = false;
  return p;
}

template <class T>
typename ToeMassBody<T>::HipOverToe ToeMassBody<T>::Relative(const T* z) const {
  HipOverToe hip = {T(0.0), z[kY] - z[kToeY], z[kVx] - z[kToeVx], z[kVy] - z[kToeVy],
                    z[kToeX] - z[kX]};
  if (flight_ == Flight::kFirst) TakeRoundingOut(z, hip);
  return hip;
}

// A leg still relaxed to rounding is taken to be so: a sensitivity that is zero but for rounding
// would otherwise be noise, which no step can follow.
template <class T>
void ToeMassBody<T>::TakeRoundingOut(const T* z, HipOverToe& hip) const {
  constexpr double kRounding = 1e-13;  // m, m/s
  const double theta = Value(body_.TouchdownAngle(z)), length = Value(length_);
  const std::array<double, kLegStateSize> rest = {0.0, length * std::cos(theta), 0.0, 0.0,
                                                  length * std::sin(theta)};
  for (int i = 0; i < kLegStateSize; ++i) {
    if (std::abs(Value(hip[i]) - rest[i]) > kRounding) return;
  }
  for (int i = 0; i < kLegStateSize; ++i) hip[i] = Chain(hip[i], rest[i], 1.0);
}

template <class T>
LegLoad<T> ToeMassBody<T>::SwingLoad(const T& t, const HipOverToe& hip) const {
  if (extended_) return swing_->extended().Load(Mode::kToe, hip.data(), {t, T(0.0)});
  return swing_->Load(Mode::kToe, hip.data());
}

template <class T>
T ToeMassBody<T>::LegAngle(const T* z) {
  using std::atan2;
  return atan2(z[kToeX] - z[kX], z[kY] - z[kToeY]);
}

template <class T>
typename ToeMassBody<T>::Swing ToeMassBody<T>::SwingAt(const T& t, const T* z) const {
  using std::atan2;
  const HipOverToe over = Relative(z);
  Swing s{SwingLoad(t, over), atan2(over[kContact], over[kY]), T(0.0), {}, {}};
  const LegLoad<T>& load = s.load;
  // dtheta/dt
  const T rate = -(load.y * over[kVx] + load.u * over[kVy]) / (load.l * load.l);
  s.torque = p_.kd_place * rate - p_.kp_place * (body_.TouchdownAngle(z) - s.theta);  // M41
  s.hip = {s.torque, body_.SinceFirstRow(t), z[kVx], load.u / load.l, s.theta,
           rate,     1.0 - load.l / length_};
  if (body_.effects().HasHipTorque()) body_.effects().AddHipTorque(s.hip, s.torque);
  s.torque += body_.effects().JointTorque({rate});
  const T chord = body_.ChordForce(load, t) / load.l, normal = s.torque / (load.l * load.l);
  s.force = {normal * load.y - chord * load.u, chord * load.y + normal * load.u};
  return s;
}

// How far below the hip the leg reaches at its angle and length [m]; M43.
template <class T>
T ToeMassBody<T>::ReachDown(const T* z) const {
  const LegLoad<T> load = SwingLoad(T(0.0), z);
  const T rest = body_.leg().TouchdownHeight(LegAngle(z));
  return body_.effects().ContactHeight(rest * load.l / length_);
}

// Where the toe is in stance: on the ground, or while rolling the tip of a half circle that
// stands on the contact.
template <class T>
Vector2<T> ToeMassBody<T>::HeldToe(Mode mode, const T& t, const T* z) const {
  const LegLoad<T> load = body_.Load(mode, t, z);
  if (mode != Mode::kRolling) return {z[kX] + load.u, T(0.0)};
  return {z[kX] + 2.0 * load.u, load.u * load.u / z[kY]};
}

template class ToeMassBody<double>;
template class ToeMassBody<Jet<1>>;
template class ToeMassBody<Jet<kNarrowJet>>;
template class ToeMassBody<Jet<kWideJet>>;
template class ToeMassBody<Jet<kWidestJet>>;

}  // namespace hoplab
