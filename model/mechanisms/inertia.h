#pragma once

#include <cmath>

#include "model/effects/effect.h"
#include "model/hybrid/ground_frame.h"
#include "model/inputs.h"
#include "model/parameters.h"

namespace hoplab {

/// What a force does to the body, and gravity: mass per axis and the acceleration of free fall in
/// the frame of the ground. On a slope that frame is turned with the ground, x uphill, so gravity
/// is turned the other way.
template <class T>
struct Inertia {
  T mx, my;                     // [kg]
  T gravity_x, gravity_y;       // [m/s^2]
  bool on_guide = false;        // a vertical guide holds x
  T weight_along, weight_down;  // the parts of the weight the potential energy counts [N]

  explicit Inertia(const Parameters<T>& p)
      : mx(p.m * (1.0 + p.inertia_x)), my(p.m * (1.0 + p.inertia_y)) {
    using std::cos;
    using std::sin;
    const bool level = IsZero(p.slope);
    const T along = level ? T(0.0) : T(p.g * sin(p.slope));
    const T down = level ? p.g : T(p.g * cos(p.slope));
    on_guide = p.on_guide;
    gravity_x = on_guide ? T(0.0) : T(-along / (1.0 + p.inertia_x));
    gravity_y = -down / (1.0 + p.inertia_y);
    weight_along = p.m * along;
    weight_down = p.m * down;
  }

  /// Kinetic and potential energy [J]; state (x, y, vx, vy).
  T Energy(const T* z) const {
    return 0.5 * (mx * z[2] * z[2] + my * z[3] * z[3]) + weight_along * z[0] + weight_down * z[1];
  }
};

/// Adds the force that the run's inputs put on the body, from W into the frame of the ground.
template <class T>
void AddInputForce(const InputSignals<T>& inputs, const T& slope, const T& t, Vector2<T>& force) {
  if (!inputs.HasForce()) return;
  T x = inputs.At(InputKind::kBodyForceX, t), y = inputs.At(InputKind::kBodyForceY, t);
  GroundFrame<T>(slope).ForceFromWorld(x, y);
  force.x += x;
  force.y += y;
}

}  // namespace hoplab
