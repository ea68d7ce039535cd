#pragma once

#include <cmath>
#include <numbers>

#include "model/laws/arc_shapes.h"
#include "model/laws/sole.h"

namespace hoplab {

/// A strip of length pi r whose rest curvature falls evenly from (1 + chi)/r at the hub to
/// (1 - chi)/r at its toe (M124). Between two ends without moment its chord is, to first order in
/// chi, that of a circle as curved as the piece in use is in the mean.
template <class S>
struct UnevenArc {
  S mean, mean_slope;      // curvature of that circle times r, its slope by phi
  S turned, turned_slope;  // angle that it turns through, its slope by phi

  template <class P>
  UnevenArc(const S& phi, const P& chi)
      : mean(S(P(1.0 + chi)) - P(chi / std::numbers::pi) * phi),
        mean_slope(P(-chi / std::numbers::pi)),
        turned(phi * mean),
        turned_slope(mean + phi * mean_slope) {}
};

/// The contact arc of an unloaded leg whose tangent at the hub is turned by `angle` against that at
/// the contact [rad].
template <class T>
T UnevenArcTurnedBy(const T& angle, const T& chi) {
  using std::sqrt;
  const T full = 1.0 + chi;
  const T root = full * full - 4.0 / std::numbers::pi * chi * angle;
  // It touches zero at chi = 1, where the toe is straight.
  return 2.0 * angle / (full + sqrt(Value(root) > 0.0 ? root : T(0.0)));
}

/// By how much both end tangents of the piece in use are turned against its chord [rad]: none of a
/// circle.
template <class T>
T UnevenTilt(const T& phi, const T& chi) {
  using std::tan;
  return chi / std::numbers::pi * (2.0 - phi / tan(0.5 * phi));
}
/// Its slope by phi.
template <class T>
T UnevenTiltSlope(const T& phi, const T& chi) {
  using std::sin;
  using std::tan;
  const T S = sin(0.5 * phi);
  return chi / std::numbers::pi * (0.5 * phi / (S * S) - 1.0 / tan(0.5 * phi));
}

}  // namespace hoplab
