#pragma once

#include <array>
#include <cmath>

#include "base/units.h"
#include "model/jet.h"

// How a leg bends in the air: the first bending mode of a half circle that is clamped at its hip
// (M98). All of it is for a leg of unit mass, unit radius and E I = 1.

namespace hoplab {

/// What the mode carries at unit rate, of a leg at angle 0.
struct LegBending {
  double along, up;     // mean of the displacement
  double about;         // of its moment about the hip
  Vector2<double> toe;  // displacement of the toe
  double stiffness;     // force on the mode per displacement: square of its frequency [rad^2/s^2]
  /// That of a leg whose first part is held by a clamp: times (1 - clamp/pi)^-kByClamp.
  static constexpr double kByClamp = 3.22;
};
const LegBending& FirstBending();

/// Its curvature, per scale, by the powers 2 to 5 of w = u/pi, u the angle from the toe: Ritz's
/// method in these four, 1e-6 of the frequency's square.
inline constexpr std::array<double, 4> kBendingCurvature = {1.0, 6.6955541, -8.61145659,
                                                            2.54155907};

/// Displacement of the point at the angle `u` from the toe, but for BendingScale, of a leg at angle
/// 0: that of a strip which turns by the integral of the curvature from its hip on.
template <class S>
Vector2<S> BendingShape(const S& u) {
  // Integrals of the curvature, and of it times sin u and cos u: of u^j by parts.
  struct Sum {
    S turn, with_sin, with_cos;
  };
  const auto until = [](const S& at) {
    const S s = sin(at), c = cos(at);
    Sum sum{S(0.0), S(0.0), S(0.0)};
    S by_sin = -c, by_cos = s, power = S(1.0);
    double scale = 1.0;
    for (int j = 1; j < 6; ++j) {
      power *= at;
      scale /= kPi;
      const S last = by_sin;
      by_sin = static_cast<double>(j) * by_cos - power * c;
      by_cos = power * s - static_cast<double>(j) * last;
      if (j < 2) continue;
      const double share = kBendingCurvature[static_cast<std::size_t>(j - 2)] * scale;
      sum.turn += share / (j + 1) * (power * at);
      sum.with_sin += share * by_sin;
      sum.with_cos += share * by_cos;
    }
    return sum;
  };
  const Sum whole = until(S(kPi)), beyond = until(u);
  const S turn = whole.turn - beyond.turn, by_sin = whole.with_sin - beyond.with_sin,
          by_cos = whole.with_cos - beyond.with_cos;
  return {turn * cos(u) - by_cos, by_sin - turn * sin(u)};
}

/// The factor by which the mean square of the displacement is 1.
double BendingScale();

/// Displacement of the point at the angle `u` from the toe, its mean square over the leg 1, of a
/// leg turned to the angle `angle`.
template <class S>
Vector2<S> BendingAt(const S& u, const S& angle) {
  const Vector2<S> at = BendingShape(u);
  const S c = BendingScale() * cos(angle), s = BendingScale() * sin(angle);
  return {c * at.x - s * at.y, s * at.x + c * at.y};
}

}  // namespace hoplab
