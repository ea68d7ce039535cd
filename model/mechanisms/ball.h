#pragma once

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "model/hybrid/hybrid_system.h"
#include "model/laws/leg_load.h"
#include "model/mechanisms/inertia.h"
#include "model/mechanisms/mechanism_setup.h"

namespace hoplab {

/// The air that a ball displaces carries it, and half as much moves along (M114). A ball is weighed
/// in air, so both act like mass without weight.
template <class T>
Parameters<T> WithDisplacedAir(Parameters<T> p) {
  if (p.air_density == 0.0) return p;
  const T air = (p.air_density * 4.0 / 3.0 * kPi) * (p.radius * p.radius * p.radius);
  const T share = 1.5 * air / p.m;
  p.inertia_x += share;
  p.inertia_y += share;
  return p;
}

/// A ball: ballistic flight, and at each bounce vy+ = -restitution vy-,
/// vx+ = (1 - tangential_loss) vx-. State: x, y, vx, vy of its centre, on a slope in the frame of
/// the ground. One mode. With a contact time it stays on the ground for that long (M115): y goes
/// down and up again, x on at the mean of both speeds, and vx, vy are those it will leave with.
template <class T>
class Ball final : public HybridSystem<T> {
 public:
  /// Bounces closer than this end the run as `came_to_rest` [s].
  static constexpr double kRestInterval = 1e-6;
  /// A shorter contact is told by where the flight after it comes from [s].
  static constexpr double kShortestContact = 1e-7;

  explicit Ball(const MechanismSetup<T>& setup)
      : p_(WithDisplacedAir(setup.parameters)),
        effects_(setup.effects),
        inertia_(p_),
        inputs_(setup.inputs),
        has_body_force_(effects_.HasBodyForce() || inputs_.HasForce()) {}

  int size() const override { return 4; }
  void Derivative(Mode, const T& t, const T* z, T* dz) const override {
    if (contact_.on) {
      dz[kX] = contact_.vx;
      dz[kY] = ContactSpeed(t);
      dz[kVx] = dz[kVy] = T(0.0);
      return;
    }
    dz[kX] = z[kVx];
    dz[kY] = z[kVy];
    dz[kVx] = inertia_.gravity_x;
    dz[kVy] = inertia_.gravity_y;
    if (has_body_force_) {
      Vector2<T> force = effects_.BodyForce(MotionAt(t, z));
      AddInputForce(inputs_, p_.slope, t, force);
      if (!inertia_.on_guide) dz[kVx] += force.x / inertia_.mx;
      dz[kVy] += force.y / inertia_.my;
    }
  }

  int GuardCount(Mode) const override { return kOwnGuards + effects_.corner_count(); }
  GuardSpec Guard(Mode, int i) const override {
    if (i >= kOwnGuards) return effects_.CornerSpec(i - kOwnGuards);
    return i == 0 ? GuardSpec{EventKind::kBounce, 0.1} : GuardSpec{EventKind::kApex, 1.0};
  }
  void Guards(Mode, const T& t, const T* z, T* g) const override {
    g[0] = contact_.on ? T(1.0) : T(z[kY] - p_.radius);
    g[1] = contact_.on ? T(1.0) : z[kVy];
    if (effects_.corner_count() == 0) return;
    const BodyMotion<T> body = MotionAt(t, z);
    effects_.CornerGuards({.body = &body}, g + kOwnGuards);
  }
  ResetResult Reset(Mode mode, int i, const T& t, T* z) override {
    if (i == 1) return {mode};
    if (i >= kOwnGuards) {
      const BodyMotion<T> body = MotionAt(t, z);
      effects_.CrossCorner(i - kOwnGuards, {.body = &body});
      return {mode};
    }
    const Vector2<T> arriving{z[kVx], z[kVy]};
    z[kVx] *= 1.0 - p_.tangential_loss;
    z[kVy] *= -effects_.Restitution(-z[kVy], p_.restitution);
    effects_.ChangeBounceSpeed({arriving, z[kVy]}, z[kVx]);
    const double next_interval = -2.0 * Value(z[kVy]) / Value(inertia_.gravity_y);
    if (!(next_interval >= kRestInterval)) return {mode, Outcome::kCameToRest};
    BeginContact(mode, t, arriving, z);
    Seat(t, z);
    return {mode};
  }

  void Touch(Mode, int i) override { effects_.TouchCorner(i - kOwnGuards); }
  Mode Begin(Mode mode, T* z) override {
    contact_ = {};
    Seat(T(0.0), z);
    return mode;
  }
  void SaveDiscreteState(DiscreteState& to) const override {
    inputs_.Save(to);
    effects_.SaveCorners(to);
    to.Put(contact_.on ? 1.0 : 0.0);
    for (const T* value : {&contact_.begin, &contact_.vx, &contact_.speed}) to.Put(Value(*value));
  }
  void LoadDiscreteState(DiscreteState& from) override {
    inputs_.Load(from);
    effects_.LoadCorners(from);
    contact_.on = from.Take() != 0.0;
    for (T* value : {&contact_.begin, &contact_.vx, &contact_.speed}) *value = T(from.Take());
  }
  double NextKnot(Mode) const override {
    const double of_inputs = inputs_.NextKnot(true);
    return contact_.on ? std::min(of_inputs, Value(ContactEnd())) : of_inputs;
  }
  std::optional<T> PassKnot(Mode, double t, T* z) override {
    if (!contact_.on || inputs_.NextKnot(true) < Value(ContactEnd())) return inputs_.Pass(true, t);
    contact_.on = false;
    z[kY] += Value(p_.radius) - Value(z[kY]);  // but for rounding it is there
    return ContactEnd();
  }

  bool IsBallistic(Mode) const override { return !has_body_force_ && !contact_.on; }
  BallisticFlight<T> Ballistic(const T*) const override {
    return {inertia_.gravity_x, inertia_.gravity_y, p_.radius};
  }
  /// Free flight, for what comes after the end of a run.
  std::optional<BallisticFlight<T>> FreeFlight() const override { return Ballistic(nullptr); }
  double FirstStep(Mode, const T*) const override { return 0.01; }

  Observation<T> Observe(Mode, const T& t, const T* z) const override {
    Observation<T> seen = this->Unseen();
    seen[Channel::kBodyX] = z[kX];
    seen[Channel::kBodyY] = z[kY];
    seen[Channel::kBodyVx] = contact_.on ? contact_.vx : z[kVx];
    seen[Channel::kBodyVy] = contact_.on ? ContactSpeed(t) : z[kVy];
    seen[Channel::kContact] = T(contact_.on ? 1.0 : 0.0);
    return seen;
  }
  T Energy(Mode, const T* z) const override { return inertia_.Energy(z); }

 private:
  static constexpr int kOwnGuards = 2;

  // The ball is on the ground since `begin`, where it came with the `speed`; x goes on with vx.
  struct Contact {
    bool on = false;
    T begin{0.0}, vx{0.0}, speed{0.0};
  };
  T ContactEnd() const { return contact_.begin + p_.contact_time; }
  // dy/dt of half a sine, which is at the ground again when the contact ends.
  T ContactSpeed(const T& t) const {
    using std::cos;
    return -contact_.speed * cos(kPi * (t - contact_.begin) / p_.contact_time);
  }
  // From a state at the ground that leaves it.
  void BeginContact(Mode mode, const T& t, const Vector2<T>& arriving, T* z) {
    contact_ = {true, t, 0.5 * (arriving.x + z[kVx]), -arriving.y};
    if (Value(p_.contact_time) >= kShortestContact) return;
    contact_.on = false;
    T leaving[4];
    Derivative(mode, t, z, leaving);
    leaving[kX] -= contact_.vx;
    const T half_square = 0.5 * p_.contact_time * p_.contact_time;
    for (int i = 0; i < 4; ++i) z[i] -= p_.contact_time * leaving[i];
    z[kX] += half_square * leaving[kVx];
    z[kY] += half_square * leaving[kVy];
  }
  BodyMotion<T> MotionAt(const T& t, const T* z) const {
    return {t + p_.time_origin, z[kX], z[kY], z[kVx], z[kVy]};
  }
  void Seat(const T& t, const T* z) {
    if (effects_.corner_count() == 0) return;
    const BodyMotion<T> body = MotionAt(t, z);
    effects_.SeatCorners({.body = &body});
  }

  Parameters<T> p_;
  ActiveEffects<T> effects_;
  Inertia<T> inertia_;
  InputSignals<T> inputs_;
  bool has_body_force_;
  Contact contact_;
};

}  // namespace hoplab
