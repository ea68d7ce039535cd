#pragma once

#include <cmath>

#include "model/parameters.h"

namespace hoplab {

/// Speed controller on the hip (M15): T = kp (v_des - vx), clipped to the torque limit. Which side
/// of the limit it is on is a discrete state, so that the corner is an event and not a surprise
/// inside a step.
template <class T>
class SpeedController {
 public:
  explicit SpeedController(const Parameters<T>& p)
      : kp_(p.kp), v_des_(p.v_des), limit_(p.torque_limit) {}

  /// Hip torque [N m], positive pushes the hip forward.
  T Torque(const T& vx) const {
    return saturation_ == 0 ? T(kp_ * (v_des_ - vx)) : T(saturation_ * limit_);
  }
  /// dT/dt at acceleration `ax` [N m/s]; none at the limit.
  T TorqueRate(const T& ax) const { return saturation_ == 0 ? T(-kp_ * ax) : T(0.0); }
  bool limited() const { return std::isfinite(limit_); }
  double limit() const { return limit_; }
  /// Guard: zero where the torque meets (or comes back from) its limit; positive before.
  T Guard(const T& vx) const {
    const T raw = kp_ * (v_des_ - vx);
    const T size = Value(raw) < 0.0 ? T(-raw) : raw;
    return saturation_ == 0 ? T(limit_ - size) : T(size - limit_);
  }
  /// Where stance begins: on the side of the limit the torque is on.
  void Enter(double vx) {
    const double raw = Value(kp_) * (Value(v_des_) - vx);
    saturation_ = raw > limit_ ? 1 : (raw < -limit_ ? -1 : 0);
  }
  /// The guard was crossed.
  void Cross(double vx) {
    const double raw = Value(kp_) * (Value(v_des_) - vx);
    saturation_ = saturation_ != 0 ? 0 : (raw > 0.0 ? 1 : -1);
  }
  int saturation() const { return saturation_; }
  void set_saturation(int s) { saturation_ = s; }

 private:
  T kp_, v_des_;
  double limit_;
  int saturation_ = 0;
};

}  // namespace hoplab
