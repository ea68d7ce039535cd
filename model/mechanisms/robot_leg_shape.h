#pragma once

#include <array>

namespace hoplab {

/// A leg of unit mass and unit radius whose foot holds, by its quasi-static shape at no load (M89):
/// a point of it moves as Phi (vx, vy, b), the motion of its hip over the foot and the rate of its
/// base. Of the angle Psi between contact and hip.
struct LegShape {
  static constexpr int kCount = 20;
  enum Field {
    // Mean of Phi^T Phi: its mass matrix.
    kXX,
    kXY,
    kYY,
    kXB,
    kYB,
    kBB,
    // Mean of Phi: the velocity of its centre of mass, along and up.
    kAlongX,
    kAlongY,
    kAlongB,
    kUpX,
    kUpY,
    kUpB,
    // Mean of Phi^T (k x place from the hip): how it takes up the motion of a rigid leg.
    kTurnX,
    kTurnY,
    kTurnB,
    // Mean of Phi^T (bending, M98): how it takes up how a leg bent in the air.
    kBendingX,
    kBendingY,
    kBendingB,
    // Where that bending takes the point that comes to the ground.
    kContactX,
    kContactY
  };
  std::array<double, kCount> value, slope, bend;  // and two derivatives by Psi
};

/// From Psi = 0.2 to 3.6, from a table; outside as at its ends.
LegShape LegShapeAt(double psi);

/// The same by quadrature, values alone.
std::array<double, LegShape::kCount> LegShapeByQuadrature(double psi);

}  // namespace hoplab
