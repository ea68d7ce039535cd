#pragma once

#include <cmath>

#include "model/parameters.h"

namespace hoplab {

/// Half angle of a contact arc with its sine and cosine: what every shape function needs.
struct HalfAngle {
  double h, sin, cos;  // phi/2 [rad]
  explicit HalfAngle(double phi) : h(0.5 * phi), sin(std::sin(h)), cos(std::cos(h)) {}
};

/// A function of the contact arc with its first two derivatives with respect to phi.
struct ShapeValue {
  double value, d1, d2;
};

/// f(phi) = 2 phi - 3 sin phi + phi cos phi (M1): bending part of the chord compliance. The closed
/// form loses digits as f -> phi^5/60, so its series is used below phi = 1.
ShapeValue BendingShape(const HalfAngle& a);
/// 3 sin phi - phi (M2): normal-force part.
ShapeValue AxialShape(const HalfAngle& a);
/// phi - sin phi (M2): shear part.
ShapeValue ShearShape(const HalfAngle& a);
/// g(phi) of M2b, C2 = (r^5/(E I)^2) g(phi) with
/// g = 3/4 phi^2 S K^2 + 9/2 phi K^3 - 3/4 phi K - 17/2 S K^2 + S, S = sin(phi/2), K = cos(phi/2);
/// g -> 17 phi^7/13440 as phi -> 0, by its series below phi = 1.5.
ShapeValue SecondOrderShape(const HalfAngle& a);

/// Chord compliance of an arc of radius r (M2) as a function of phi alone: what does not depend on
/// phi, computed once. All four members are differentiable in E, G, r, I, A, kappa.
template <class T>
struct LegCompliance {
  T bending;       // r^3/(2 E I)      [m/N]
  T axial;         // r/(2 E A)        [m/N]
  T shear;         // kappa r/(2 G A)  [m/N]
  T second_order;  // r^5/(E I)^2      [m/N^2]

  LegCompliance() = default;
  explicit LegCompliance(const Parameters<T>& p) : LegCompliance(p, p.r) {}
  /// With another radius than the rest radius (the deformed radius r_d of `thesis`).
  LegCompliance(const Parameters<T>& p, const T& radius) {
    const T bending_stiffness = p.E * p.I;
    bending = radius * radius * radius / (2.0 * bending_stiffness);
    axial = radius / (2.0 * p.E * p.A);
    shear = p.kappa * radius / (2.0 * p.G * p.A);
    second_order = 4.0 * bending * bending / radius;
  }

  /// C(phi) [m/N], M2.
  T Chord(const ShapeValue& b, const ShapeValue& a, const ShapeValue& s) const {
    return bending * b.value + axial * a.value + shear * s.value;
  }
  /// dC/dphi [m/(N rad)]; M4 is this over r.
  T ChordD1(const ShapeValue& b, const ShapeValue& a, const ShapeValue& s) const {
    return bending * b.d1 + axial * a.d1 + shear * s.d1;
  }
  /// d2C/dphi2 [m/(N rad^2)].
  T ChordD2(const ShapeValue& b, const ShapeValue& a, const ShapeValue& s) const {
    return bending * b.d2 + axial * a.d2 + shear * s.d2;
  }
  /// C(phi) [m/N] from the angle.
  T Chord(double phi) const {
    const HalfAngle h(phi);
    return Chord(BendingShape(h), AxialShape(h), ShearShape(h));
  }
  /// C(phi) [m/N] at an angle that carries directions.
  T ChordAt(const T& phi) const {
    const HalfAngle h(Value(phi));
    const ShapeValue b = BendingShape(h), a = AxialShape(h), s = ShearShape(h);
    return Chord(b, a, s) + Value(ChordD1(b, a, s)) * (phi - Value(phi));
  }
  /// C2(phi) [m/N^2], M2b.
  T SecondOrder(double phi) const { return second_order * SecondOrderShape(HalfAngle(phi)).value; }
};

}  // namespace hoplab
