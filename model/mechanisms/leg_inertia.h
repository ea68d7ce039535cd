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

/// A C-leg of rest radius `r`: a circular arc from the hip to the contact, of the length the law
/// says, and beyond the contact the rest of the half circle.
template <class T>
LegInertia<T> ArcInertia(const T& mass, const T& r, const LegLoad<T>& load) {
  using S = Tangent<T>;
  const T zero(0.0), one(1.0);
  const S u(load.u, load.place_x - 1.0, load.place_y), y(load.y, zero, one);
  const S phi(load.phi, load.arc_x, load.arc_y), arc = r * phi, l = sqrt(u * u + y * y);
  const S unit(one);
  const auto lift = [](const S& x, const std::array<double, 3>& derivatives) {
    return Lift(x, derivatives.data(), 0);
  };
  const S q = l / arc, w = lift(q, HalfTurn(Value(q)));
  const double sin_w = std::sin(Value(w)), cos_w = std::cos(Value(w));
  const S S_half = lift(w, {sin_w, cos_w, -sin_w}), K_half = lift(w, {cos_w, -sin_w, -cos_w});
  const S psi = w + w, R = arc / psi;
  const S s = 2.0 * (S_half * K_half), flat = 2.0 * (S_half * S_half), c = unit - flat;
  // M56: the hip's velocity by that of the rolled length and of the radius, its inverse.
  const S b_x = psi * c - s, b_y = flat - psi * s;
  const S inverse = unit / (flat * b_y - s * b_x);
  const S s_x = b_y * inverse, s_y = T(-1.0) * (b_x * inverse);
  const S R_x = T(-1.0) * (s * inverse), R_y = flat * inverse;
  // Kinetic energy of the arc and of what lies beyond the contact.
  const T density = mass / (std::numbers::pi * r);
  const S beyond = S(T(std::numbers::pi)) - phi;
  const double sin_b = std::sin(Value(beyond)), cos_b = std::cos(Value(beyond));
  const S over = beyond - lift(beyond, {sin_b, cos_b, -sin_b});
  const S rise = unit - lift(beyond, {cos_b, -sin_b, -cos_b});
  const S weight = density * R;
  const S rolling = weight * (2.0 * (psi - s)) + 2.0 * (density * r) * over;
  const S mixed = weight * (psi * s - flat - 0.5 * (psi * psi));
  const S bending =
      weight * ((1.0 / 3.0) * (psi * psi * psi) + 2.0 * (psi - s - s) + 2.0 * (psi * c));
  const S m_xx = s_x * (rolling * s_x + 2.0 * (mixed * R_x)) + bending * (R_x * R_x);
  const S m_xy = s_x * (rolling * s_y + mixed * R_y) + R_x * (mixed * s_y + bending * R_y);
  const S m_yy = s_y * (rolling * s_y + 2.0 * (mixed * R_y)) + bending * (R_y * R_y);
  // The arc's chord lies where the leg's does.
  const S cos_t = (y * S_half + u * K_half) / l, sin_t = (u * S_half - y * K_half) / l;
  const S cc = cos_t * cos_t, ss = sin_t * sin_t, cs = cos_t * sin_t;
  const S per_length = (1.0 / std::numbers::pi) * (R * R / S(r)), tail(T(r / std::numbers::pi));
  const S x_c = tail * rise - per_length * flat, y_c = tail * over + per_length * (psi - s);
  return {.xx = cc * m_xx - 2.0 * (cs * m_xy) + ss * m_yy,
          .xy = cs * (m_xx - m_yy) + (cc - ss) * m_xy,
          .yy = ss * m_xx + 2.0 * (cs * m_xy) + cc * m_yy,
          .x = u + cos_t * x_c - sin_t * y_c,
          .y = sin_t * x_c + cos_t * y_c - y};
}

}  // namespace hoplab
