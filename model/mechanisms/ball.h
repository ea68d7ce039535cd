#pragma once

#include <cmath>
#include <limits>

#include "model/effects/active_effects.h"
#include "model/hybrid/automaton.h"
#include "model/hybrid/ballistic.h"
#include "model/laws/leg_load.h"
#include "model/mechanisms/inertia.h"
#include "model/observation.h"

namespace hoplab {

/// A ball: ballistic flight, and at each bounce vy+ = -restitution vy-,
/// vx+ = (1 - tangential_loss) vx-. State: x, y, vx, vy of its centre, on a slope in the frame of
/// the ground. One mode.
template <class T>
class Ball {
 public:
  using Scalar = T;
  static constexpr int kDim = 4;
  /// Bounces closer than this end the run as `came_to_rest` [s].
  static constexpr double kRestInterval = 1e-6;

  Ball(const Parameters<T>& parameters, const ActiveEffects<T>& effects, LiftoffRule)
      : p_(parameters), effects_(effects), inertia_(p_), has_body_force_(effects.HasBodyForce()) {}

  template <class Other>
  void CopyHidden(const Other&) {}

  void StartSearch(Mode, const double*) {}

  void Derivative(Mode, const T& t, const T* z, T* dz) const {
    dz[kX] = z[kVx];
    dz[kY] = z[kVy];
    dz[kVx] = inertia_.gravity_x;
    dz[kVy] = inertia_.gravity_y;
    if (has_body_force_) {
      const Vector2<T> force = effects_.BodyForce({t, z[kX], z[kY], z[kVx], z[kVy]});
      dz[kVx] += force.x / inertia_.mx;
      dz[kVy] += force.y / inertia_.my;
    }
  }

  int GuardCount(Mode) const { return 2; }
  GuardSpec Guard(Mode, int i) const {
    return i == 0 ? GuardSpec{EventKind::kBounce, 0.1} : GuardSpec{EventKind::kApex, 1.0};
  }
  void Guards(Mode, const T&, const T* z, T* g) const {
    g[0] = z[kY] - p_.radius;
    g[1] = z[kVy];
  }
  ResetResult Reset(Mode mode, int i, const T&, T* z) {
    if (i == 1) return {mode};
    z[kVx] *= 1.0 - p_.tangential_loss;
    z[kVy] *= -effects_.Restitution(-z[kVy], p_.restitution);
    const double next_interval = -2.0 * Value(z[kVy]) / Value(inertia_.gravity_y);
    if (!(next_interval >= kRestInterval)) return {mode, Outcome::kCameToRest};
    return {mode};
  }

  bool IsBallistic(Mode) const { return !has_body_force_; }
  BallisticFlight<T> Ballistic(const T*) const {
    return {inertia_.gravity_x, inertia_.gravity_y, p_.radius};
  }
  double FirstStep(Mode, const T*) const { return 0.01; }

  Observation<T> Observe(Mode, const T&, const T* z) const {
    Observation<T> seen;
    for (T& c : seen.channel) c = T(std::numeric_limits<double>::quiet_NaN());
    seen[Channel::kBodyX] = z[kX];
    seen[Channel::kBodyY] = z[kY];
    seen[Channel::kBodyVx] = z[kVx];
    seen[Channel::kBodyVy] = z[kVy];
    seen[Channel::kContact] = T(0.0);
    return seen;
  }
  T Energy(Mode, const T* z) const { return inertia_.Energy(z); }
  double Flexure(Mode, const T*) const { return 0.0; }

 private:
  Parameters<T> p_;
  ActiveEffects<T> effects_;
  Inertia<T> inertia_;
  bool has_body_force_;
};

}  // namespace hoplab
