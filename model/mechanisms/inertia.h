#pragma once

#include <cmath>

#include "model/parameters.h"

namespace hoplab {

/// What a force does to the body, and gravity: mass per axis and the acceleration of free fall in
/// the frame of the ground. On a slope that frame is turned with the ground, x uphill, so gravity
/// is turned the other way.
template <class T>
struct Inertia {
  T mx, my;                     // [kg]
  T gravity_x, gravity_y;       // [m/s^2]
  T weight_along, weight_down;  // the parts of the weight the potential energy counts [N]

  explicit Inertia(const Parameters<T>& p)
      : mx(p.m * (1.0 + p.inertia_x)), my(p.m * (1.0 + p.inertia_y)) {
    using std::cos;
    using std::sin;
    const bool level = IsZero(p.slope);
    const T along = level ? T(0.0) : T(p.g * sin(p.slope));
    const T down = level ? p.g : T(p.g * cos(p.slope));
    gravity_x = -along / (1.0 + p.inertia_x);
    gravity_y = -down / (1.0 + p.inertia_y);
    weight_along = p.m * along;
    weight_down = p.m * down;
  }

  /// Kinetic and potential energy [J]; state (x, y, vx, vy).
  T Energy(const T* z) const {
    return 0.5 * (mx * z[2] * z[2] + my * z[3] * z[3]) + weight_along * z[0] + weight_down * z[1];
  }
};

}  // namespace hoplab
