#pragma once

#include <cmath>

#include "model/jet.h"
#include "model/observation.h"
#include "model/robot_parameters.h"

namespace hoplab {

/// The frame an automaton runs in: turned about the origin with a sloping ground, so that the
/// ground is its x axis. Requests, samples, events and final states are in world W.
template <class T>
class GroundFrame {
 public:
  /// `slope` of the ground [rad], uphill forward.
  explicit GroundFrame(const T& slope) : slope_(slope), level_(IsZero(slope)) {
    if (level_) return;
    using std::cos;
    using std::sin;
    cos_ = cos(slope);
    sin_ = sin(slope);
  }
  bool level() const { return level_; }

  /// Position and velocity (x, y, vx, vy) from W to the frame of the ground, and back.
  void FromWorld(T* z) const {
    if (level_) return;
    Turn(-sin_, z[0], z[1]);
    Turn(-sin_, z[2], z[3]);
  }
  void ToWorld(T* z) const {
    if (level_) return;
    Turn(sin_, z[0], z[1]);
    Turn(sin_, z[2], z[3]);
  }
  /// Body channels.
  void BodyToWorld(Observation<T>& seen) const {
    if (level_) return;
    Turn(sin_, seen[Channel::kBodyX], seen[Channel::kBodyY]);
    Turn(sin_, seen[Channel::kBodyVx], seen[Channel::kBodyVy]);
  }
  /// A vector.
  void VectorToWorld(T& x, T& y) const {
    if (!level_) Turn(sin_, x, y);
  }
  /// A force in W to the frame of the ground.
  void ForceFromWorld(T& x, T& y) const {
    if (!level_) Turn(-sin_, x, y);
  }
  /// The coordinate along the ground of a place that lies at `x` in W, and back.
  T AlongGround(const T& x) const { return level_ ? x : T(x / cos_); }
  /// The other channels: forces and contact turned, the leg angle measured from the horizontal.
  void LegToWorld(Observation<T>& seen) const {
    if (level_) return;
    Turn(sin_, seen[Channel::kGroundForceX], seen[Channel::kGroundForceY]);
    Turn(sin_, seen[Channel::kContactX], seen[Channel::kContactY]);
    seen[Channel::kLegAngle] += slope_;
    if (!seen.robot) return;
    for (int leg = 0; leg < kMaxLegs; ++leg) {
      Turn(sin_, seen[OfLeg(Channel::kLegContactX1, leg)],
           seen[OfLeg(Channel::kLegContactY1, leg)]);
      Turn(sin_, seen[OfLeg(Channel::kLegForceX1, leg)], seen[OfLeg(Channel::kLegForceY1, leg)]);
    }
  }

 private:
  void Turn(const T& sin, T& x, T& y) const {
    const T turned = cos_ * x - sin * y;
    y = sin * x + cos_ * y;
    x = turned;
  }

  T slope_, cos_{1.0}, sin_{0.0};
  bool level_;
};

}  // namespace hoplab
