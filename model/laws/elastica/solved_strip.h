#pragma once

#include <array>

namespace hoplab::elastica {

// What make_tables.cc tabulates: the strip solved by quadrature in long double.

using Real = long double;

/// An arc of radius 1 and E I = 1 pressed by f along its chord and across it by n at its free end,
/// where the tangent makes the angle `foot` with the chord; `hip` at the other end.
struct Shape {
  Real f, n, foot, hip;
};

/// Length, chord and height of the hip over it, with their slopes in foot, hip and n.
struct Size {
  std::array<Real, 4> length{}, along{}, across{};
};
Size SizeOf(const Shape& s);
/// Of what bends it, over E I/r.
Real StrainEnergy(const Shape& s);

/// The arc of length phi under f and the torque t at the hip, which is n times the chord. Newton
/// from a guess.
Shape Solve(Real phi, Real f, Real t, Shape s);

/// D_ij = int kappa_i kappa_j ds over the loaded arc, the place in the material, counted from the
/// hip, held: i, j are f and phi. Without torque.
struct StripDissipation {
  Real ff, fphi, phiphi;
};
StripDissipation DissipationOf(const Shape& s);

/// Chord and cosine of the tip's angle to it, by the torque at the hip: slope and half the second
/// derivative, by differences of fourth order.
struct ByTorque {
  Real chord1, chord2, lead1, lead2;
};
ByTorque ByTorqueOf(Real phi, const Shape& rest);

}  // namespace hoplab::elastica
