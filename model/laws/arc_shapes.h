#pragma once

#include <array>

#include "model/jet.h"
#include "model/laws/tangent.h"
#include "model/leg_compliance.h"

namespace hoplab {

// The k-th derivative of a function of one variable at x, given all of them at its value.
inline double Lift(double, const double* derivatives, int k) { return derivatives[k]; }
template <int N>
Jet<N> Lift(const Jet<N>& x, const double* derivatives, int k) {
  return Jet<N>(derivatives[k], derivatives[k + 1] * x.v);
}
template <class T>
Tangent<T> Lift(const Tangent<T>& x, const double* derivatives, int k) {
  const T slope = Lift(x.value, derivatives, k + 1);
  return {Lift(x.value, derivatives, k), slope * x.rate[0], slope * x.rate[1]};
}

// Shape functions of an arc with as many derivatives as the rates of the tip's angle need.
struct ArcShapes {
  std::array<double, 3> sin, cos;  // of phi/2
  std::array<double, 5> bending;   // M1
  std::array<double, 4> axial, shear, second_order;

  explicit ArcShapes(double phi) {
    const HalfAngle a(phi);
    const double h = a.h, S = a.sin, K = a.cos;
    const double sin_phi = 2.0 * S * K, cos_phi = 1.0 - 2.0 * S * S;
    sin = {S, 0.5 * K, -0.25 * S};
    cos = {K, -0.5 * S, -0.25 * K};
    const ShapeValue b = BendingShape(a), n = AxialShape(a), s = ShearShape(a),
                     g = SecondOrderShape(a);
    bending = {b.value, b.d1, b.d2, phi * sin_phi, sin_phi + phi * cos_phi};
    axial = {n.value, n.d1, n.d2, -3.0 * cos_phi};
    shear = {s.value, s.d1, s.d2, cos_phi};
    const double S2 = S * S, K2 = K * K;
    const double g3 = 2.0 * h * S * (6.0 * S2 - 21.0 * K2) + h * h * K * (60.0 * S2 - 21.0 * K2) +
                      K * (30.0 * S2 - 15.0 * K2 + 1.5) + h * S * (105.0 * K2 - 30.0 * S2 - 1.5) +
                      K * (12.0 * K2 - 73.5 * S2 + 1.5);
    second_order = {g.value, g.d1, g.d2, 0.125 * g3};
  }
};

}  // namespace hoplab
