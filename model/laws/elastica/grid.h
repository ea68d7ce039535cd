#pragma once

#include <cmath>
#include <numbers>

namespace hoplab::elastica {

/// What is tabulated of the pressed arc (M61, M63, M121), each divided by the powers of phi and f
/// that it begins with.
enum Table {
  kDissipationFF,      // D_ff/phi^5 of M63
  kDissipationFPhi,    // D_fphi/(f phi^4)
  kDissipationPhiPhi,  // D_phiphi/(f^2 phi^3)
  kTorqueChord,        // c1/phi^3 of M121
  kTorqueChord2,       // c2/phi^3
  kTorqueLead,         // b1/phi^2
  kTorqueLead2,        // b2/phi^2
  kSplineCount,
  kEnergy = kSplineCount,  // b of M61
  kTableCount
};

/// The tables are splines of degree 5 over cells of equal size in the arc phi and in the load
/// z = f w(phi), which is 1 where the domain ends.
inline constexpr int kDegree = 5;
inline constexpr int kPhiCells = 72, kLoadCells = 56;
inline constexpr int kPhiCount = kPhiCells + kDegree, kLoadCount = kLoadCells + kDegree;
inline constexpr double kPhiBegin = 0.15, kPhiEnd = 4.05;
inline constexpr double kLoadBegin = -0.17, kLoadEnd = 1.03;

/// The domain: arcs a leg stands on, and those a step may look at past the toe; from a pull to the
/// load at which the ends of a half circle have come to a tenth of their distance.
inline constexpr double kLeastPhi = 0.2, kMostPhi = 3.9;
inline constexpr double kLeastLoad = -0.15, kMostLoad = 1.0;

/// w(phi) = phi^2 p(phi)/pi^2: loads in units of the Euler load of a straight rod of that length,
/// times p, which takes short arcs to two fifths of it and long ones to all of it.
template <class T>
T LoadScale(const T& phi) {
  const T p = 3.0 + phi * (-1.9 + phi * (0.57 - 0.055 * phi));
  return phi * phi * p / (std::numbers::pi * std::numbers::pi);
}

}  // namespace hoplab::elastica
