#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "model/laws/extended_statics.h"
#include "model/laws/leg_load.h"
#include "model/parameters.h"

namespace hoplab {

/// A leg whose mass is spread evenly along it, in stance, by Rayleigh's method (M56-M58): all of it
/// follows the hip. The slopes are those along the hip's x and y, with the contact following as the
/// law has it.
template <class T>
struct LegInertia {
  Tangent<T> xx, xy, yy;  // mass matrix, M56 [kg]
  Tangent<T> x, y;        // centre of mass, seen from the hip, M57 [m]
};

/// Half of the angle psi that an arc turns through, from its chord over its length, q = 2
/// sin(psi/2) /psi, with two derivatives by q.
inline std::array<double, 3> HalfTurn(double q) {
  constexpr double kLeast = 0.05;  // rad; a straight line has none
  double w = 0.5 * std::numbers::pi;
  double slope = 1.0, bend = 0.0;
  for (int round = 0; round < 20; ++round) {
    const double s = std::sin(w), c = std::cos(w);
    slope = (w * c - s) / (w * w);
    bend = -s / w - 2.0 * slope / w;
    const double step = (s / w - q) / slope;
    w = std::clamp(w - step, kLeast, std::numbers::pi);
    if (std::abs(step) < 1e-14) break;
  }
  return {w, 1.0 / slope, -bend / (slope * slope * slope)};
}

/// A straight leg: a bar from the contact to the hip.
template <class T>
LegInertia<T> BarInertia(const T& mass, const LegLoad<T>& load) {
  const T zero(0.0), third = mass / 3.0, half(0.5);
  return {.xx = Tangent<T>(third),
          .xy = Tangent<T>(zero),
          .yy = Tangent<T>(third),
          .x = Tangent<T>(0.5 * load.u, -half, zero),
          .y = Tangent<T>(-0.5 * load.y, zero, -half)};
}

/// How the mean velocity of the leg's mass follows the hip's, seen from the contact (M87).
template <class T>
struct LegMomentum {
  Tangent<T> xx, xy, yx, yy;  // of the leg's x by the hip's x, by its y, ... [-]

  /// Its rate along a motion of the hip (vx, vy), less what the hip's acceleration gives.
  T TurnX(const T& vx, const T& vy) const { return Turn(xx, xy, vx, vy); }
  T TurnY(const T& vx, const T& vy) const { return Turn(yx, yy, vx, vy); }

 private:
  static T Turn(const Tangent<T>& by_x, const Tangent<T>& by_y, const T& vx, const T& vy) {
    return (by_x.rate[0] * vx + by_x.rate[1] * vy) * vx +
           (by_y.rate[0] * vx + by_y.rate[1] * vy) * vy;
  }
};

/// M87 of a foot that slides: what moves hip and foot, and how.
template <class T>
struct SlidingFoot {
  LegInertia<T> leg;
  LegMomentum<T> momentum;
  Vector2<T> force;       // on the hip over the foot [N]
  Vector2<T> outside;     // on body and leg as one, the ground's left out [N]
  std::array<T, 3> rate;  // of the hip's velocity over the foot, of the foot's [m/s^2]
  T press;                // what the ground holds [N]
};

template <class T>
LegMomentum<T> BarMomentum() {
  const T zero(0.0), half(0.5);
  return {.xx = half, .xy = zero, .yx = zero, .yy = half};
}

/// Shape of a C-leg: a circular arc from the hip to the contact, of the length the law says, and
/// beyond the contact the rest of the half circle. What a hip's velocity by x and y rolls (s_x,
/// s_y) and unbends (R_x, R_y), in the frame in which the tangent at the contact is level.
template <class T>
struct ArcShape {
  using S = Tangent<T>;
  S u, y, psi, R, s, flat, c, s_x, s_y, R_x, R_y, over, rise, cos_t, sin_t;
};

/// Sine or cosine of `x`, its value and two derivatives given.
template <class T>
Tangent<T> LiftTangent(const Tangent<T>& x, const std::array<double, 3>& derivatives) {
  return Lift(x, derivatives.data(), 0);
}

template <class T>
[[gnu::flatten]] ArcShape<T> ShapeOfArc(const T& r, const T& sole, const LegLoad<T>& load) {
  using S = Tangent<T>;
  const T zero(0.0), one(1.0);
  const S u(load.u, load.place_x - 1.0, load.place_y), y(load.y - sole, zero, one);
  const S phi(load.phi, load.arc_x, load.arc_y), arc = r * phi, l = sqrt(u * u + y * y);
  const S unit(one);
  const S q = l / arc, w = LiftTangent(q, HalfTurn(Value(q)));
  const double sin_w = std::sin(Value(w)), cos_w = std::cos(Value(w));
  const S S_half = LiftTangent(w, {sin_w, cos_w, -sin_w});
  const S K_half = LiftTangent(w, {cos_w, -sin_w, -cos_w});
  const S psi = w + w, R = arc / psi;
  const S s = 2.0 * (S_half * K_half), flat = 2.0 * (S_half * S_half), c = unit - flat;
  // M56: the hip's velocity by that of the rolled length and of the radius, its inverse.
  const S b_x = psi * c - s, b_y = flat - psi * s;
  const S inverse = unit / (flat * b_y - s * b_x);
  const S beyond = S(T(std::numbers::pi)) - phi;
  const double sin_b = std::sin(Value(beyond)), cos_b = std::cos(Value(beyond));
  // The arc's chord lies where the leg's does.
  return {.u = u,
          .y = y,
          .psi = psi,
          .R = R,
          .s = s,
          .flat = flat,
          .c = c,
          .s_x = b_y * inverse,
          .s_y = T(-1.0) * (b_x * inverse),
          .R_x = T(-1.0) * (s * inverse),
          .R_y = flat * inverse,
          .over = beyond - LiftTangent(beyond, {sin_b, cos_b, -sin_b}),
          .rise = unit - LiftTangent(beyond, {cos_b, -sin_b, -cos_b}),
          .cos_t = (y * S_half + u * K_half) / l,
          .sin_t = (u * S_half - y * K_half) / l};
}

template <class T>
[[gnu::flatten]] LegInertia<T> ArcInertia(const T& mass, const T& r, const ArcShape<T>& a) {
  using S = Tangent<T>;
  // Kinetic energy of the arc and of what lies beyond the contact.
  const T density = mass / (std::numbers::pi * r);
  const S weight = density * a.R;
  const S rolling = weight * (2.0 * (a.psi - a.s)) + 2.0 * (density * r) * a.over;
  const S mixed = weight * (a.psi * a.s - a.flat - 0.5 * (a.psi * a.psi));
  const S bending = weight * ((1.0 / 3.0) * (a.psi * a.psi * a.psi) + 2.0 * (a.psi - a.s - a.s) +
                              2.0 * (a.psi * a.c));
  const S m_xx = a.s_x * (rolling * a.s_x + 2.0 * (mixed * a.R_x)) + bending * (a.R_x * a.R_x);
  const S m_xy =
      a.s_x * (rolling * a.s_y + mixed * a.R_y) + a.R_x * (mixed * a.s_y + bending * a.R_y);
  const S m_yy = a.s_y * (rolling * a.s_y + 2.0 * (mixed * a.R_y)) + bending * (a.R_y * a.R_y);
  const S cc = a.cos_t * a.cos_t, ss = a.sin_t * a.sin_t, cs = a.cos_t * a.sin_t;
  const S per_length = (1.0 / std::numbers::pi) * (a.R * a.R / S(r)), tail(T(r / std::numbers::pi));
  const S x_c = tail * a.rise - per_length * a.flat;
  const S y_c = tail * a.over + per_length * (a.psi - a.s);
  return {.xx = cc * m_xx - 2.0 * (cs * m_xy) + ss * m_yy,
          .xy = cs * (m_xx - m_yy) + (cc - ss) * m_xy,
          .yy = ss * m_xx + 2.0 * (cs * m_xy) + cc * m_yy,
          .x = a.u + a.cos_t * x_c - a.sin_t * y_c,
          .y = a.sin_t * x_c + a.cos_t * y_c - a.y};
}

template <class T>
[[gnu::flatten]] LegMomentum<T> ArcMomentum(const T& r, const ArcShape<T>& a) {
  using S = Tangent<T>;
  const S arc = (1.0 / std::numbers::pi) * (a.R / S(r)), tail(T(1.0 / std::numbers::pi));
  // Means of a and b (M56) over the leg.
  const S a_x = arc * (a.psi - a.s) + tail * a.over, a_y = arc * a.flat - tail * a.rise;
  const S b_x = arc * (a.psi * a.s - 2.0 * a.flat);
  const S b_y = arc * (a.psi - 2.0 * a.s + a.psi * a.c);
  const S xx = a_x * a.s_x + b_x * a.R_x, xy = a_x * a.s_y + b_x * a.R_y;
  const S yx = a_y * a.s_x + b_y * a.R_x, yy = a_y * a.s_y + b_y * a.R_y;
  const S cc = a.cos_t * a.cos_t, ss = a.sin_t * a.sin_t, cs = a.cos_t * a.sin_t;
  return {.xx = cc * xx - cs * (xy + yx) + ss * yy,
          .xy = cs * (xx - yy) + cc * xy - ss * yx,
          .yx = cs * (xx - yy) + cc * yx - ss * xy,
          .yy = ss * xx + cs * (xy + yx) + cc * yy};
}

}  // namespace hoplab
