#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "model/mechanisms/legged_body.h"

// A leg with a mass of its own, M56-M60 and M88, and its foot where it slides, M87.

namespace hoplab {

template <class T, class LegT>
LegInertia<T> LeggedBody<T, LegT>::InertiaOfLeg(const LegLoad<T>& load) const {
  const T& mass = p_.law_terms.leg_mass;
  return is_bar_ ? BarInertia(mass, load)
                 : ArcInertia(mass, p_.r, ShapeOfArc(p_.r, p_.law_terms.sole, load));
}
template <class T, class LegT>
LegMomentum<T> LeggedBody<T, LegT>::MomentumOfLeg(const LegLoad<T>& load) const {
  return is_bar_ ? BarMomentum<T>() : ArcMomentum(p_.r, ShapeOfArc(p_.r, p_.law_terms.sole, load));
}

// An unloaded leg on the ground at leg angle `theta`, as it hangs from the hip in flight.
template <class T, class LegT>
LegLoad<T> LeggedBody<T, LegT>::Placed(const T& theta) const {
  LegLoad<T> load{};
  load.u = Lead(theta);
  load.y = leg_->TouchdownHeight(theta);
  using std::sqrt;
  load.l = sqrt(load.u * load.u + load.y * load.y);
  load.phi = Value(theta) > 0.0 ? T(std::numbers::pi - theta) : T(std::numbers::pi);
  return load;
}

// The leg's share of the kinetic energy, less what the weighed mass counts of it.
template <class T, class LegT>
T LeggedBody<T, LegT>::KineticEnergyOfLeg(const LegLoad<T>& load, const T* z) const {
  const LegInertia<T> leg = InertiaOfLeg(load);
  const T &m_leg = p_.law_terms.leg_mass, &vx = z[kVx], &vy = z[kVy];
  if (slides_ == 0.0) {
    return 0.5 * ((leg.xx.value - m_leg) * vx * vx + (leg.yy.value - m_leg) * vy * vy) +
           leg.xy.value * vx * vy;
  }
  const LegMomentum<T> momentum = MomentumOfLeg(load);
  const T &foot = z[FootSpeed()], wx = vx - foot;
  return 0.5 * (leg.xx.value * wx * wx + leg.yy.value * vy * vy + m_leg * foot * foot) +
         leg.xy.value * wx * vy + m_leg * foot * (momentum.xx.value * wx + momentum.xy.value * vy) -
         0.5 * m_leg * (vx * vx + vy * vy);
}

// Right side of M58: forces and weight, less what the change of the mass matrix takes beyond what
// its slopes give. (vx, vy) is the hip's velocity over the foot.
template <class T, class LegT>
Vector2<T> LeggedBody<T, LegT>::HeavyForce(const LegInertia<T>& leg, const Vector2<T>& force,
                                           const T& vx, const T& vy) const {
  const T& m_leg = p_.law_terms.leg_mass;
  const T along = inertia_.weight_along / p_.m, down = inertia_.weight_down / p_.m;
  const auto change = [&](const Tangent<T>& of) { return T(of.rate[0] * vx + of.rate[1] * vy); };
  const auto slope = [&](int k) {
    return T(0.5 * (leg.xx.rate[k] * vx * vx + leg.yy.rate[k] * vy * vy) +
             leg.xy.rate[k] * vx * vy);
  };
  const auto weight = [&](int k) {
    return T(m_leg * (along * leg.x.rate[k] + down * leg.y.rate[k]));
  };
  return {force.x - inertia_.weight_along - weight(0) + slope(0) -
              (change(leg.xx) * vx + change(leg.xy) * vy),
          force.y - inertia_.weight_down - weight(1) + slope(1) -
              (change(leg.xy) * vx + change(leg.yy) * vy)};
}

// M58: Lagrange's equations of body and leg under the force on the hip.
template <class T, class LegT>
Vector2<T> LeggedBody<T, LegT>::HeavyAcceleration(const LegLoad<T>& load, const Vector2<T>& force,
                                                  const T* z) const {
  const LegInertia<T> leg = InertiaOfLeg(load);
  const T& m_leg = p_.law_terms.leg_mass;
  const T xx = inertia_.mx - m_leg + leg.xx.value, yy = inertia_.my - m_leg + leg.yy.value;
  const T& xy = leg.xy.value;
  const Vector2<T> f = HeavyForce(leg, force, z[kVx], z[kVy]);
  if (inertia_.on_guide) return {T(0.0), f.y / yy};
  const T over = 1.0 / (xx * yy - xy * xy);
  return {over * (yy * f.x - xy * f.y), over * (xx * f.y - xy * f.x)};
}

// M59: body and leg come down as one and go on as the law lets the leg follow the hip. Where the
// blow leaves the cone of friction, the foot slides.
template <class T, class LegT>
void LeggedBody<T, LegT>::TakeLegAlong(const LegLoad<T>& load, T* z) {
  const LegInertia<T> leg = InertiaOfLeg(load);
  const LegMomentum<T> momentum = MomentumOfLeg(load);
  const T &m_leg = p_.law_terms.leg_mass, vx = z[kVx], vy = z[kVy];
  const T body_x = inertia_.mx - m_leg, body_y = inertia_.my - m_leg;
  const T xx = body_x + leg.xx.value, yy = body_y + leg.yy.value;
  const T& xy = leg.xy.value;
  const T px = body_x * vx + m_leg * (momentum.xx.value * vx + momentum.yx.value * vy);
  const T py = body_y * vy + m_leg * (momentum.xy.value * vx + momentum.yy.value * vy);
  if (inertia_.on_guide) {
    z[kVy] = py / yy;
    return;
  }
  const T over = 1.0 / (xx * yy - xy * xy);
  const T wx = over * (yy * px - xy * py), wy = over * (xx * py - xy * px);
  if (foot_has_inertia_) {
    const T blow_x =
        body_x * wx + m_leg * (momentum.xx.value * wx + momentum.xy.value * wy) - inertia_.mx * vx;
    const T blow_y =
        body_y * wy + m_leg * (momentum.yx.value * wx + momentum.yy.value * wy) - inertia_.my * vy;
    const double inverse = Value(p_.law_terms.foot_friction);
    if (inverse * std::abs(Value(blow_x)) > Value(blow_y)) {
      const double side = Value(blow_x) < 0.0 ? 1.0 : -1.0;
      const std::array<T, 3> after = SolveSliding(
          leg, momentum, side,
          {px, py, p_.law_terms.foot_friction * inertia_.mx * vx + side * inertia_.my * vy});
      if (side * Value(after[2]) > 0.0) {
        slides_ = side;
        z[kVx] = after[0] + after[2];
        z[kVy] = after[1];
        z[FootSpeed()] = after[2];
        return;
      }
    }
  }
  z[kVx] = wx;
  z[kVy] = wy;
}

// M60: the leg springs back and swings forward; the centre of mass of both goes on. The state is
// that of a body whose leg has swung.
template <class T, class LegT>
void LeggedBody<T, LegT>::LeaveWithLeg(const LegLoad<T>& load, const T& t, T* z) {
  const LegInertia<T> leg = InertiaOfLeg(load);
  const LegMomentum<T> momentum = MomentumOfLeg(load);
  const LegInertia<T> placed = InertiaOfLeg(Placed(TouchdownAngle(t, z)));
  const T share_x = p_.law_terms.leg_mass / inertia_.mx;
  const T share_y = p_.law_terms.leg_mass / inertia_.my;
  const T vx = z[kVx], vy = z[kVy];
  const T foot = slides_ != 0.0 ? z[FootSpeed()] : T(0.0);
  const T wx = vx - foot;
  swing_begin_ = t;
  swing_x_ = inertia_.on_guide ? T(0.0) : T(share_x * (placed.x.value - leg.x.value));
  swing_y_ = share_y * (placed.y.value - leg.y.value);
  if (!inertia_.on_guide) {
    z[kX] += share_x * (leg.x.value - placed.x.value);
    z[kVx] += share_x * (momentum.xx.value * wx + momentum.xy.value * vy - wx);
  }
  z[kY] += share_y * (leg.y.value - placed.y.value);
  z[kVy] += share_y * (momentum.yx.value * wx + momentum.yy.value * vy - vy);
  swing_time_ = IsZero(inertia_.gravity_y) ? T(0.0) : T(z[kVy] / -inertia_.gravity_y);
}

// M88: how far the body is from where it were with its leg swung forward. At the apex the leg is.
template <class T, class LegT>
void LeggedBody<T, LegT>::AddSwing(const T& t, Observation<T>& seen) const {
  const T& whole = swing_time_;
  const T since = t - swing_begin_;
  if (!(Value(since) >= 0.0 && Value(since) < Value(whole))) return;
  using std::cos;
  using std::sin;
  const T turn = std::numbers::pi * since / whole;
  const T left = 0.5 * (1.0 + cos(turn)), rate = -0.5 * std::numbers::pi / whole * sin(turn);
  seen[Channel::kBodyX] += swing_x_ * left;
  seen[Channel::kBodyY] += swing_y_ * left;
  seen[Channel::kBodyVx] += swing_x_ * rate;
  seen[Channel::kBodyVy] += swing_y_ * rate;
}

// ---- a foot that slides, M87 ---------------------------------------------------------------

// The left side of M87, its unknowns (dvx/dt over the foot, dvy/dt, the foot's acceleration), or
// the velocities after a blow.
template <class T, class LegT>
std::array<T, 3> LeggedBody<T, LegT>::SolveSliding(const LegInertia<T>& leg,
                                                   const LegMomentum<T>& momentum, double side,
                                                   std::array<T, 3> right) const {
  const T &m_leg = p_.law_terms.leg_mass, &inverse = p_.law_terms.foot_friction;
  const T body_x = inertia_.mx - m_leg, body_y = inertia_.my - m_leg;
  const T carried = body_x + m_leg * momentum.xx.value, across = m_leg * momentum.xy.value;
  std::array<std::array<T, 3>, 3> a = {
      {{body_x + leg.xx.value, leg.xy.value, carried},
       {leg.xy.value, body_y + leg.yy.value, across},
       {inverse * carried + side * m_leg * momentum.yx.value,
        inverse * across + side * (body_y + m_leg * momentum.yy.value), inverse * inertia_.mx}}};
  for (int i = 0; i < 2; ++i) {
    for (int k = i + 1; k < 3; ++k) {
      const T share = a[k][i] / a[i][i];
      for (int j = i + 1; j < 3; ++j) a[k][j] -= share * a[i][j];
      right[k] -= share * right[i];
    }
  }
  right[2] /= a[2][2];
  right[1] = (right[1] - a[1][2] * right[2]) / a[1][1];
  right[0] = (right[0] - a[0][1] * right[1] - a[0][2] * right[2]) / a[0][0];
  return right;
}

template <class T, class LegT>
SlidingFoot<T> LeggedBody<T, LegT>::SlidingFootOf(const LegLoad<T>& load, const Vector2<T>& force,
                                                  Mode mode, const T& t, const T* z) const {
  SlidingFoot<T> foot{InertiaOfLeg(load), MomentumOfLeg(load), {}, {}, {}, {}};
  const LegMomentum<T>& momentum = foot.momentum;
  const T &m_leg = p_.law_terms.leg_mass, &inverse = p_.law_terms.foot_friction;
  const T &speed = z[FootSpeed()], &wy = z[kVy], wx = z[kVx] - speed;
  foot.force = HeavyForce(foot.leg, force, wx, wy);
  // The mean velocity of the leg is no gradient to the last: what its curl takes.
  const T curl = m_leg * speed * (momentum.xy.rate[0] - momentum.xx.rate[1]);
  foot.force.x += curl * wy;
  foot.force.y -= curl * wx;
  foot.outside = {-inertia_.weight_along, -inertia_.weight_down};
  if (has_body_force_) {
    const Vector2<T> push = BodyForce(mode, t, z);
    foot.outside.x += push.x;
    foot.outside.y += push.y;
  }
  foot.outside.x -= m_leg * momentum.TurnX(wx, wy);
  foot.outside.y -= m_leg * momentum.TurnY(wx, wy);
  foot.rate = SolveSliding(
      foot.leg, momentum, slides_,
      {foot.force.x, foot.force.y, inverse * foot.outside.x + slides_ * foot.outside.y});
  foot.press = (inertia_.my - m_leg) * foot.rate[1] +
               m_leg * (momentum.yx.value * foot.rate[0] + momentum.yy.value * foot.rate[1]) -
               foot.outside.y;
  return foot;
}

template <class T, class LegT>
void LeggedBody<T, LegT>::SlidingAcceleration(const LegLoad<T>& load, const Vector2<T>& force,
                                              Mode mode, const T& t, const T* z, T* dz) const {
  const SlidingFoot<T> foot = SlidingFootOf(load, force, mode, t, z);
  if (is_lifted_) return LiftFoot(foot, dz);
  dz[kVx] = foot.rate[0] + foot.rate[2];
  dz[kVy] = foot.rate[1];
  dz[FootSpeed()] = foot.rate[2];
}

// How much the ground would have to pull on a foot that slides [N].
template <class T, class LegT>
T LeggedBody<T, LegT>::PullOfGround(Mode mode, const LegLoad<T>& load, const T& t,
                                    const T* z) const {
  Vector2<T> force = HipForce(load, HipTorque(mode, load, t, z), t);
  if (has_body_force_) {
    const Vector2<T> push = BodyForce(mode, t, z);
    force = {force.x + push.x, force.y + push.y};
  }
  return -SlidingFootOf(load, force, mode, t, z).press;
}

// M122: no ground pulls. Where a torque would have it pull on a foot that lands, it gives nothing,
// and the foot is free upwards, too: body and leg as one go on under the other forces, the hip over
// the foot under the leg's.
template <class T, class LegT>
void LeggedBody<T, LegT>::LiftFoot(const SlidingFoot<T>& foot, T* dz) const {
  const LegInertia<T>& leg = foot.leg;
  const LegMomentum<T>& momentum = foot.momentum;
  const T &m_leg = p_.law_terms.leg_mass, &mx = inertia_.mx, &my = inertia_.my;
  const T body_x = mx - m_leg, body_y = my - m_leg;
  // Momentum of all by the velocity of the hip over the foot: [row: along, up][column].
  const T xx = body_x + m_leg * momentum.xx.value, xy = m_leg * momentum.xy.value;
  const T yx = m_leg * momentum.yx.value, yy = body_y + m_leg * momentum.yy.value;
  // The foot's acceleration is (outside - that . w)/m: what is left of the hip's own equations.
  const T a = body_x + leg.xx.value - xx * xx / mx - yx * yx / my;
  const T b = leg.xy.value - xx * xy / mx - yx * yy / my;
  const T c = body_y + leg.yy.value - xy * xy / mx - yy * yy / my;
  const T along = foot.outside.x / mx, up = foot.outside.y / my;
  const T right_x = foot.force.x - xx * along - yx * up;
  const T right_y = foot.force.y - xy * along - yy * up;
  const T over = 1.0 / (a * c - b * b);
  const T wx = over * (c * right_x - b * right_y), wy = over * (a * right_y - b * right_x);
  dz[FootSpeed()] = along - (xx * wx + xy * wy) / mx;
  dz[kVx] = wx + dz[FootSpeed()];
  dz[kVy] = wy + up - (yx * wx + yy * wy) / my;
}

// What the ground gives a leg whose foot holds: what body and leg take, less the other forces.
template <class T, class LegT>
Vector2<T> LeggedBody<T, LegT>::GroundForce(Mode mode, const LegLoad<T>& load, const T& t,
                                            const T* z) const {
  Vector2<T> force = HipForce(load, HipTorque(mode, load, t, z), t);
  Vector2<T> outside{-inertia_.weight_along, -inertia_.weight_down};
  if (has_body_force_) {
    const Vector2<T> push = BodyForce(mode, t, z);
    force = {force.x + push.x, force.y + push.y};
    outside = {outside.x + push.x, outside.y + push.y};
  }
  const Vector2<T> a = HeavyAcceleration(load, force, z);
  const LegMomentum<T> momentum = MomentumOfLeg(load);
  const T &m_leg = p_.law_terms.leg_mass, &vx = z[kVx], &vy = z[kVy];
  return {(inertia_.mx - m_leg) * a.x +
              m_leg * (momentum.xx.value * a.x + momentum.xy.value * a.y + momentum.TurnX(vx, vy)) -
              outside.x,
          (inertia_.my - m_leg) * a.y +
              m_leg * (momentum.yx.value * a.x + momentum.yy.value * a.y + momentum.TurnY(vx, vy)) -
              outside.y};
}

/// F_y - |F_x|/mu of a foot that holds [N].
template <class T, class LegT>
T LeggedBody<T, LegT>::ConeMargin(Mode mode, const LegLoad<T>& load, const T& t, const T* z) const {
  const Vector2<T> force = GroundForce(mode, load, t, z);
  const T along = Value(force.x) < 0.0 ? T(-force.x) : force.x;
  return force.y - p_.law_terms.foot_friction * along;
}

// Whether a torque acts on the hip.
template <class T, class LegT>
bool LeggedBody<T, LegT>::Pushes(Mode mode, const T& t, const T* z) const {
  return Value(HipTorque(mode, Load(mode, t, z), t, z)) != 0.0;
}
template <class T, class LegT>
bool LeggedBody<T, LegT>::HoldsWithin(Mode mode, const T& t, const T* z) const {
  return Value(ConeMargin(mode, Load(mode, t, z), t, z)) > 0.0;
}
template <class T, class LegT>
void LeggedBody<T, LegT>::BeginSlide(Mode mode, const T& t, T* z) {
  const Vector2<T> force = GroundForce(mode, Load(mode, t, z), t, z);
  z[FootSpeed()] = T(0.0);
  slides_ = Value(force.x) < 0.0 ? 1.0 : -1.0;
}
// A foot that lands and slides as a torque pushes it is off the ground from then on, where that
// would have to pull.
template <class T, class LegT>
void LeggedBody<T, LegT>::MayLift(Mode mode, const T& t, const T* z) {
  if (!CanLift() || slides_ == 0.0 || !Pushes(mode, t, z)) return;
  is_lifted_ = Value(PullOfGround(mode, Load(mode, t, z), t, z)) > 0.0;
}
// The foot loses its hold, or comes to hold: but where the ground would have to hold it the other
// way by more than its cone, it turns round.
template <class T, class LegT>
void LeggedBody<T, LegT>::ResetFoot(EventKind event, Mode mode, const T& t, T* z) {
  if (event == EventKind::kSlide) return BeginSlide(mode, t, z);
  const double went = slides_;
  LetFootGo(z);
  if (HoldsWithin(mode, t, z)) return;
  BeginSlide(mode, t, z);
  if (slides_ == went) LetFootGo(z);
}
template <class T, class LegT>
void LeggedBody<T, LegT>::LetFootGo(T* z) {
  slides_ = 0.0;
  is_lifted_ = false;
  z[FootSpeed()] = T(0.0);
}

}  // namespace hoplab
