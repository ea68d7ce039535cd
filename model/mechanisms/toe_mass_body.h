#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/mechanisms/legged_body.h"

namespace hoplab {

/// Two bodies in free fall side by side: a hip and its toe on a relaxed leg at rest.
template <class T>
struct PairFlight {
  BallisticFlight<T> hip;

  template <std::size_t kDim>
  void Advance(const T& dt, std::array<T, kDim>& z) const {
    hip.Advance(dt, z);
    z[kToeX] += dt * (z[kToeVx] + 0.5 * hip.ax * dt);
    z[kToeY] += dt * (z[kToeVy] + 0.5 * hip.ay * dt);
    z[kToeVx] += hip.ax * dt;
    z[kToeVy] += hip.ay * dt;
  }
  Crossing Next(double t, double end, const T* z) const { return hip.Next(t, end, z); }
};

/// A body on a leg with a second point mass at its toe (M40-M46; thesis 4.7-4.14). In flight hip
/// and toe are two bodies joined by the chord spring and the placement torque; in stance the toe is
/// held, the leg is the massless one, and only what ends a stance differs.
/// State: ToeState. Modes: those of the massless leg.
template <class T, template <class> class LegT>
class ToeMassBody {
 public:
  using Scalar = T;
  static constexpr int kDim = kToeStateSize;

  ToeMassBody(const Parameters<T>& parameters, const ActiveEffects<T>& effects, LiftoffRule liftoff)
      : p_(parameters),
        body_(parameters, effects, liftoff),
        swing_(InTheAir(parameters)),
        extended_(parameters.law_terms.active),
        // Nothing tells hip and toe apart while a relaxed leg falls.
        falls_freely_(!effects.HasBodyForce() && !effects.HasHipTorque() &&
                      IsZero(parameters.inertia_x) && IsZero(parameters.inertia_y) &&
                      (IsZero(parameters.slope) || !effects.HasTouchdownAngle())),
        gravity_x_(-body_.inertia().weight_along / parameters.m),
        gravity_y_(-body_.inertia().weight_down / parameters.m) {
    swing_.StartSearch(Mode::kToe, nullptr);
    const T upright[] = {T(0.0), T(1.0), T(0.0), T(0.0), T(0.0)};
    length_ = swing_.RestChord(swing_.Load(Mode::kToe, upright));
  }

  template <class Other>
  void CopyHidden(const Other& other) {
    body_.CopyHidden(other.body());
    swing_.CopyHidden(other.swing());
    flight_ = static_cast<Flight>(other.flight());
    may_pull_ = other.may_pull();
  }
  void StartSearch(Mode mode, const double* z) {
    if (mode != Mode::kFlight) body_.StartSearch(mode, z);
  }
  /// The toe of a leg at rest against the hip, relaxed at the touch-down angle.
  void PlaceToe(T* z) const {
    using std::cos;
    using std::sin;
    const T theta = body_.TouchdownAngle(z);
    z[kToeX] = z[kX] + length_ * sin(theta);
    z[kToeY] = z[kY] - length_ * cos(theta);
    z[kToeVx] = z[kVx];
    z[kToeVy] = z[kVy];
  }

  void Derivative(Mode mode, const T& t, const T* z, T* dz) const {
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

  // Guards in flight: touch-down (not while the hip rises after a lift-off), apex (not once it was
  // passed), fall by height, fall by angle. In stance those of the massless leg.
  int GuardCount(Mode mode) const {
    if (mode != Mode::kFlight) return body_.GuardCount(mode);
    return flight_ == Flight::kFirst ? 4 : flight_ == Flight::kRising ? 2 : 3;
  }
  GuardSpec Guard(Mode mode, int i) const {
    if (mode != Mode::kFlight) {
      GuardSpec spec = body_.Guard(mode, i);
      if (spec.event != EventKind::kLiftoff) return spec;
      spec.scale = Value(p_.m) * std::max(Value(p_.g), 1.0);
      spec.if_closed = may_pull_ ? std::nullopt : std::optional(Outcome::kNoSupport);
      return spec;
    }
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
  void Guards(Mode mode, const T& t, const T* z, T* g) const {
    if (mode != Mode::kFlight) {
      const LegLoad<T> load = body_.Load(mode, t, z);
      g[0] = LiftoffGuard(load);
      body_.StanceGuards(mode, load, z, g);
      return;
    }
    using std::cos;
    const int count = GuardCount(mode);
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
  }

  ResetResult Reset(Mode mode, int i, const T& t, T* z) {
    switch (Guard(mode, i).event) {
      case EventKind::kTouchdown:
        return TouchDown(t, z);
      case EventKind::kLiftoff:
        return LiftOff(mode, t, z);
      case EventKind::kApex:
        if (flight_ == Flight::kRising) flight_ = Flight::kFalling;
        if (Value(z[kY] - body_.TouchdownHeight(z)) < 0.0) return {mode, Outcome::kFellNoReturn};
        return {mode};
      case EventKind::kFallHeight:
        return {mode, Outcome::kFellHeight};
      case EventKind::kFallAngle:
        return {mode, Outcome::kFellAngle};
      default: {
        const ResetResult result = body_.Reset(mode, i, t, z);
        if (result.next != mode) may_pull_ = false;
        return result;
      }
    }
  }

  /// The first flight, of a relaxed leg, is in closed form.
  bool IsBallistic(Mode mode) const {
    return mode == Mode::kFlight && flight_ == Flight::kFirst && falls_freely_;
  }
  PairFlight<T> Ballistic(const T* z) const {
    return {{gravity_x_, gravity_y_, body_.TouchdownHeight(z)}};
  }

  /// In flight a tenth of a radian of the toe's oscillation on the leg, or of its decay.
  double FirstStep(Mode mode, const T* z) const {
    if (mode != Mode::kFlight) return body_.FirstStep(mode, z);
    const double toe = Value(p_.m_toe) * Value(p_.m) / (Value(p_.m_toe) + Value(p_.m));
    const LegLoad<T> load = SwingLoad(T(0.0), z);
    double step = std::min(0.01, 0.1 * std::sqrt(toe / Value(body_.leg().Stiffness(load))));
    if (Value(p_.d) > 0.0) step = std::min(step, 0.1 * toe / Value(p_.d));
    return step;
  }

  /// While a relaxed leg falls the state does not feel how stiff it is, its sensitivities do: the
  /// time in which the toe answers to being moved or pushed off its place [s].
  double LongestStep(Mode mode, const T& t, const T* z) const {
    if (mode != Mode::kFlight || flight_ != Flight::kFirst)
      return std::numeric_limits<double>::infinity();
    constexpr double kSmall = 1e-6;  // m, m/s
    T rest[kDim], answer[kDim], moved[kDim];
    Derivative(mode, t, z, rest);
    double rate = 0.0;
    for (int i = kToeX; i < kToeStateSize; ++i) {
      std::copy_n(z, kDim, moved);
      moved[i] += kSmall;
      Derivative(mode, t, moved, answer);
      const double change =
          std::hypot(Value(answer[kToeVx] - rest[kToeVx]), Value(answer[kToeVy] - rest[kToeVy])) /
          kSmall;
      rate = std::max(rate, i < kToeVx ? std::sqrt(change) : change);
    }
    return 1.0 / rate;
  }

  /// What the sensors see, before the observation effects. The ground carries the toe's weight; in
  /// flight leg angle and length are the leg's own.
  Observation<T> Observe(Mode mode, const T& t, const T* z) const {
    if (mode != Mode::kFlight) {
      Observation<T> seen = body_.Observe(mode, t, z);
      seen[Channel::kGroundForceX] -= p_.m_toe * gravity_x_;
      seen[Channel::kGroundForceY] -= p_.m_toe * gravity_y_;
      return seen;
    }
    const Swing s = SwingAt(t, z);
    Observation<T> seen;
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

  /// Kinetic, potential and strain energy of hip, toe and leg [J].
  T Energy(Mode mode, const T* z) const {
    if (mode != Mode::kFlight) {
      const Vector2<T> toe = HeldToe(mode, T(0.0), z);
      return body_.Energy(mode, z) - p_.m_toe * (gravity_x_ * toe.x + gravity_y_ * toe.y);
    }
    const LegLoad<T> load = SwingLoad(T(0.0), z);
    const T strain = extended_ ? swing_.extended().StrainEnergy(Mode::kToe, load, {T(0.0), T(0.0)})
                               : swing_.StrainEnergy(load);
    const T moving = 0.5 * (z[kToeVx] * z[kToeVx] + z[kToeVy] * z[kToeVy]);
    return body_.inertia().Energy(z) + strain +
           p_.m_toe * (moving - gravity_x_ * z[kToeX] - gravity_y_ * z[kToeY]);
  }
  double Flexure(Mode mode, const T* z) const { return body_.Flexure(mode, z); }

  const LeggedBody<T, LegT>& body() const { return body_; }
  const LegT<T>& swing() const { return swing_; }
  int flight() const { return static_cast<int>(flight_); }
  bool may_pull() const { return may_pull_; }

 private:
  // Which of its guards a flight watches.
  enum class Flight { kFirst, kRising, kFalling };

  // Hip and toe in flight, the hip over a toe at rest.
  struct Swing {
    LegLoad<T> load;
    T theta;           // leg angle [rad]
    T torque;          // on the hip, positive pushes it forward [N m]
    Vector2<T> force;  // of the leg on the hip; on the toe its opposite [N]
  };

  // The leg off the ground: nothing to sink into, to creep on or to bend it by a torque of stance.
  static Parameters<T> InTheAir(Parameters<T> p) {
    p.law_terms.ground_compliance = p.law_terms.foot_slip = p.law_terms.torque_bending = T(0.0);
    p.law_terms.torque_active = false;
    return p;
  }

  EventKind FlightEvent(int i) const {
    using enum EventKind;
    static constexpr EventKind kEvents[3][4] = {{kTouchdown, kApex, kFallHeight, kFallAngle},
                                                {kApex, kFallAngle, kSwitch, kSwitch},
                                                {kTouchdown, kFallHeight, kFallAngle, kSwitch}};
    return kEvents[static_cast<int>(flight_)][i];
  }

  // The hip over a toe that stands at (u, 0): a state for the law of a leg on its toe, which does
  // not know whether that is held.
  using HipOverToe = std::array<T, kLegStateSize>;
  HipOverToe Relative(const T* z) const {
    HipOverToe hip = {T(0.0), z[kY] - z[kToeY], z[kVx] - z[kToeVx], z[kVy] - z[kToeVy],
                      z[kToeX] - z[kX]};
    if (flight_ == Flight::kFirst) TakeRoundingOut(z, hip);
    return hip;
  }
  // A leg still relaxed to rounding is taken to be so: a sensitivity that is zero but for rounding
  // would otherwise be noise, which no step can follow.
  void TakeRoundingOut(const T* z, HipOverToe& hip) const {
    constexpr double kRounding = 1e-13;  // m, m/s
    const double theta = Value(body_.TouchdownAngle(z)), length = Value(length_);
    const std::array<double, kLegStateSize> rest = {0.0, length * std::cos(theta), 0.0, 0.0,
                                                    length * std::sin(theta)};
    for (int i = 0; i < kLegStateSize; ++i) {
      if (std::abs(Value(hip[i]) - rest[i]) > kRounding) return;
    }
    for (int i = 0; i < kLegStateSize; ++i) hip[i] = Chain(hip[i], rest[i], 1.0);
  }
  LegLoad<T> SwingLoad(const T& t, const HipOverToe& hip) const {
    if (extended_) return swing_.extended().Load(Mode::kToe, hip.data(), {t, T(0.0)});
    return swing_.Load(Mode::kToe, hip.data());
  }
  LegLoad<T> SwingLoad(const T& t, const T* z) const { return SwingLoad(t, Relative(z)); }
  static T LegAngle(const T* z) {
    using std::atan2;
    return atan2(z[kToeX] - z[kX], z[kY] - z[kToeY]);
  }
  Swing SwingAt(const T& t, const T* z) const {
    using std::atan2;
    const HipOverToe over = Relative(z);
    Swing s{SwingLoad(t, over), atan2(over[kContact], over[kY]), T(0.0), {}};
    const LegLoad<T>& load = s.load;
    // dtheta/dt
    const T rate = -(load.y * over[kVx] + load.u * over[kVy]) / (load.l * load.l);
    s.torque = p_.kd_place * rate - p_.kp_place * (body_.TouchdownAngle(z) - s.theta);  // M41
    if (body_.effects().HasHipTorque()) {
      const HipMotion<T> hip{s.torque, rate, t, z[kVx], load.u / load.l};
      body_.effects().AddHipTorque(hip, s.torque);
    }
    const T chord = body_.ChordForce(load) / load.l, normal = s.torque / (load.l * load.l);
    s.force = {normal * load.y - chord * load.u, chord * load.y + normal * load.u};
    return s;
  }
  // How far below the hip the leg reaches at its angle and length [m]; M43.
  T ReachDown(const T* z) const {
    const LegLoad<T> load = SwingLoad(T(0.0), z);
    const T rest = body_.leg().TouchdownHeight(LegAngle(z));
    return body_.effects().ContactHeight(rest * load.l / length_);
  }
  // M45: the chord lifts the toe's weight.
  T LiftoffGuard(const LegLoad<T>& load) const {
    return body_.ChordForce(load) * load.y / load.l - p_.m_toe * gravity_y_;
  }

  // M44: the toe's velocity is lost, the contact is where the leg touches.
  ResetResult TouchDown(const T& t, T* z) {
    using std::sin;
    const T theta = LegAngle(z);
    const LegLoad<T> load = SwingLoad(t, z);
    const auto& leg = body_.leg();
    const T stretch = load.l / length_ - 1.0;
    const T ahead = stretch * leg.ShownLength(theta) * sin(leg.ChordAngle(theta));
    const ResetResult landed = body_.Land(theta, t, z, [&](T* at) { at[kContact] += ahead; });
    for (int i = kToeY; i < kToeStateSize; ++i) z[i] = T(0.0);
    may_pull_ = true;
    const LegLoad<T> now = body_.Load(landed.next, t, z);
    if (Value(LiftoffGuard(now)) <= 0.0 && Value(now.damping_rate) >= 0.0)
      return {landed.next, Outcome::kNoSupport};
    return landed;
  }
  // M46: the toe leaves at rest from where it was held.
  ResetResult LiftOff(Mode mode, const T& t, T* z) {
    const Vector2<T> toe = HeldToe(mode, t, z);
    if (body_.effects().HasLiftoffVelocity()) body_.ApplyLiftoff(body_.Load(mode, t, z), z);
    z[kToeX] = toe.x;
    z[kToeY] = toe.y;
    z[kToeVx] = z[kToeVy] = T(0.0);
    flight_ = Value(z[kVy]) > 0.0 ? Flight::kRising : Flight::kFalling;
    swing_.StartSearch(Mode::kToe, nullptr);
    return body_.LeftGround(z);
  }
  // Where the toe is in stance: on the ground, or while rolling the tip of a half circle that
  // stands on the contact.
  Vector2<T> HeldToe(Mode mode, const T& t, const T* z) const {
    const LegLoad<T> load = body_.Load(mode, t, z);
    if (mode != Mode::kRolling) return {z[kX] + load.u, T(0.0)};
    return {z[kX] + 2.0 * load.u, load.u * load.u / z[kY]};
  }

  Parameters<T> p_;
  LeggedBody<T, LegT> body_;
  LegT<T> swing_;
  bool extended_, falls_freely_;
  T gravity_x_, gravity_y_;
  T length_;  // chord of the unloaded leg to its toe [m]
  Flight flight_ = Flight::kFirst;
  bool may_pull_ = true;
};

}  // namespace hoplab
