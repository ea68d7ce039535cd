#pragma once

#include <array>

#include "model/jet.h"

namespace hoplab::clamped {

/// Points of the Gauss-Legendre rule along the arc. The error of the integrals is 1e-14 at the
/// loads of a robot that walks and 1e-8 where the arc is bent nearly straight (M80; the test prints
/// a table).
inline constexpr int kNodes = 16;
/// Points along the arc for the dissipation of the material: 5e-9 of it at the loads of a robot
/// that walks, 1e-6 at f = 0.3.
inline constexpr int kDampingNodes = 8;
/// Least square of the curvature, in 1/r, at which the rule is trusted: beyond it the arc is
/// straightened out, and a load is NaN.
inline constexpr double kLeastCurvature2 = 0.15;

/// The tangent of an arc between contact and hip: its angle below the ground at the contact, psi_0,
/// 0 while rolling, and at the hip, Psi = pi - beta; their cosines and sines, and those at the
/// nodes.
struct Tangents {
  double tip = 0.0, base = 0.0;
  double cos_tip = 1.0, sin_tip = 0.0, cos_base = 1.0, sin_base = 0.0;
  double cos_middle = 1.0, sin_middle = 0.0;  // halfway between the two
  double c[kNodes], s[kNodes];

  Tangents() = default;
  Tangents(double tip, double base);
};

/// The integrals of M80 over the arc: of 1, cos, sin over kappa, and of 1, cos, sin, cos^2, cos
/// sin, sin^2 over kappa^3.
struct Integrals {
  double one, c, s;
  double k1, kc, ks, kcc, kcs, kss;
};

/// Under the load (fx, fy), in units of E I/r^2; NaN in `one` where the arc is straightened out.
Integrals IntegralsOf(const Tangents& at, double fx, double fy);

/// How an arc on a foot that holds answers: C of M68, in M69 the slopes of the base, and the
/// dissipation D of M71 by the rates (fx, fy, Psi) with the material held, upper triangle by rows.
template <class S>
struct Response {
  S c11, c12, c22;
  S h1, h2;
  std::array<S, 6> D;

  /// Its values, in another scalar type.
  template <class To = double>
  Response<To> Values() const {
    const auto v = [](const S& x) { return To(Value(x)); };
    return {v(c11), v(c12), v(c22),
            v(h1),  v(h2),  {v(D[0]), v(D[1]), v(D[2]), v(D[3]), v(D[4]), v(D[5])}};
  }
};

/// Rolling: the tangent at the contact is held along the ground. Else the toe: the length is held.
Response<double> ResponseOf(const Tangents& at, double fx, double fy, bool rolling,
                            bool dissipates);
/// The same with its slopes by (tip, base, fx, fy).
Response<Jet<4>> ResponseTo1(const Tangents& at, double fx, double fy, bool rolling,
                             bool dissipates);

}  // namespace hoplab::clamped
