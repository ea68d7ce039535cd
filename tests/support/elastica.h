#pragma once

namespace hoplab::testing {

/// An inextensible, unshearable elastic rod that is a circular arc at rest, pressed by a force
/// through both its free-turning ends: exact large-deflection shape, by shooting.
struct PressedArc {
  double chord;      // distance of the ends [m]
  double end_angle;  // angle of the tangent to the chord at either end [rad]
};

/// `arc` [rad], `radius` [m], bending stiffness `EI` [N m^2], chord force `F` [N], positive
/// pressing the ends together. Accurate to about 1e-13 of the length.
PressedArc SolvePressedArc(double arc, double radius, double EI, double F);

/// The same with one end held by a couple: besides `F` along the chord a force `N` [N] across it
/// acts on the free-turning end, positive where it closes the arc further; the couple at the other
/// end is N times the chord. `end_angle` is that at the free-turning end.
PressedArc SolveHeldArc(double arc, double radius, double EI, double F, double N);

}  // namespace hoplab::testing
