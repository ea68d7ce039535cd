#pragma once

#include <array>

namespace hoplab {

/// Motion of a leg: of its hip along and up, its base's rate, and its own: on the ground its foot's
/// speed where that slides, in the air the rate at which it bends.
template <class T>
using LegMotion = std::array<T, 4>;

/// What a leg of unit mass and unit length carries by its motion, or how that changes with its
/// angle.
struct LegForm {
  double mass[4][4];            // its mass matrix; rows of its own motion where it has one
  LegMotion<double> along, up;  // momentum along and up
  LegMotion<double> turn;       // M90: momenta of all motions by the rate of a rigid leg
  LegMotion<double> bending;    // M98: by that of its bending in the air

  /// Of a foot that holds: hip and base.
  void SetMass(double xx, double xy, double yy, double xb, double yb, double bb) {
    mass[0][0] = xx;
    mass[0][1] = mass[1][0] = xy;
    mass[1][1] = yy;
    mass[0][2] = mass[2][0] = xb;
    mass[1][2] = mass[2][1] = yb;
    mass[2][2] = bb;
  }
  /// M98: a leg in the air bends by one mode of unit mass: its momenta along, up and about the hip.
  void LetBend(double whole, double x, double y, double about) {
    mass[0][3] = mass[3][0] = along[3] = bending[0] = x;
    mass[1][3] = mass[3][1] = up[3] = bending[1] = y;
    mass[2][3] = mass[3][2] = turn[3] = bending[2] = about;
    mass[3][3] = bending[3] = whole;
  }
  /// M92: a foot that slides moves the whole leg along with it. `whole` is the leg's mass and
  /// `spin` and `bend` its momenta along by the rate of a rigid leg and by that of its bending.
  void LetFootMove(double whole, double spin, double bend) {
    for (int k = 0; k < 3; ++k) mass[k][3] = mass[3][k] = along[k] - mass[k][0];
    mass[3][3] = whole - along[0] - mass[0][3];
    along[3] = whole - along[0];
    up[3] = -up[0];
    turn[3] = spin - turn[0];
    bending[3] = bend - bending[0];
  }
};

}  // namespace hoplab
