#pragma once

#include <array>
#include <cmath>

#include "model/laws/arc_shapes.h"

namespace hoplab {

/// What a leg that is not a half circle on its own line is at the contact arc phi, unloaded.
template <class S>
struct Outline {
  S rest;          // chord from the hip to the ground, D0 [m]
  S lead;          // the tip's lead over it, D0'/(r + h) [-]
  S spread;        // lambda: a load bends it as lambda times the load bends the half circle [-]
  S spread_slope;  // its logarithm's slope by phi [1/rad]
};

/// A leg that bends along a circle of radius r and stands on a sole h outside it (M113): the force
/// runs from the hip to the ground, not to the line that bends.
/// `sin`, `cos` of phi; `bending` f(phi) of M1 and its slope.
template <class S, class P>
Outline<S> SoleOutlineOf(const S& phi, const S& sin, const S& cos, const S& bending,
                         const S& bending_slope, const P& r, const P& h) {
  using std::sqrt;
  const P outside = r + h, q = r / outside, q2 = 1.0 + q * q, q1 = 1.0 + q;
  const S flat = S(P(1.0)) - cos, square = S(h * h) + 2.0 * (r * outside * flat);
  const S rest = sqrt(square);
  // The square of the force's arm, over (r (r + h)/D0)^2, along the arc, and its slope.
  const S arm = 0.5 * (q2 * (phi - sin * cos)) + q * (sin - phi * cos) - 2.0 * (q1 * sin * flat) +
                phi * sin * sin;
  const S arm_slope = q2 * (sin * sin) + q * (phi * sin) - 2.0 * (q1 * (cos * flat + sin * sin)) +
                      sin * sin + 2.0 * (phi * sin * cos);
  const S rest_slope = (r * outside) * (sin / rest);
  return {.rest = rest,
          .lead = (1.0 / outside) * rest_slope,
          .spread = sqrt(((2.0 * outside * outside) * arm) / (square * bending)),
          .spread_slope = 0.5 * (arm_slope / arm - bending_slope / bending) - rest_slope / rest};
}

template <class S, class P>
Outline<S> SoleAt(const S& phi, const P& r, const P& sole) {
  const ArcShapes shapes(Value(phi));
  const double sin = std::sin(Value(phi)), cos = std::cos(Value(phi));
  const std::array<double, 5> turned = {sin, cos, -sin, -cos, sin};
  return SoleOutlineOf(phi, Lift(phi, turned.data(), 0), Lift(phi, turned.data() + 1, 0),
                       Lift(phi, shapes.bending.data(), 0), Lift(phi, shapes.bending.data(), 1), r,
                       sole);
}

/// What a sole adds to M2b, over h r^4/(E I)^2, and its slope by phi (M113).
template <class S>
struct SoleSecondOrder {
  S value, slope;
};
/// `sin`, `cos` of phi/2; `b` f/2 of M1, `g` the bracket of M2b, each with its slope.
template <class S, class P>
SoleSecondOrder<S> SoleSecondOrderOf(const S& phi, const S& sin, const S& cos, const S& b,
                                     const S& b1, const S& g, const S& g1) {
  const S S2 = sin * sin, K2 = cos * cos, SK2 = sin * K2, S3 = sin * S2, one(P(1.0));
  const S turn = 0.5 * (cos * K2) - S2 * cos, bend = 0.5 * S3 - 1.75 * SK2;
  const S b2 = sin * cos - 0.5 * (phi * (K2 - S2));  // (sin phi - phi cos phi)/2
  const S g2 = 1.5 * SK2 + 3.0 * (phi * turn) + 0.75 * (phi * phi * bend) - 13.5 * SK2 -
               6.75 * (phi * turn) + 0.75 * sin + 0.1875 * (phi * cos) - 8.5 * bend - 0.25 * sin;
  const S ahead = cos / sin, ahead1 = -0.5 * (one / S2), share = b1 / b;
  const S share1 = b2 / b - share * share;
  const S arm = b1 * b1 / S3;
  const S second = 1.5 * (share * g) - g1, second1 = 1.5 * (share1 * g + share * g1) - g2;
  return {ahead * second + 0.375 * arm,
          ahead1 * second + ahead * second1 + 0.375 * (2.0 * (b1 * b2 / S3) - 1.5 * (arm * ahead))};
}

}  // namespace hoplab
