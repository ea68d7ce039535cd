#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "model/robot_parameters.h"

namespace hoplab {

/// The reference of one leg's motor under a Buehler clock (M76): slowly through the sweep, fast
/// through the rest of the turn. Where the two meet is a knot; which piece it is in is a discrete
/// state, 2 k in the slow part of turn k and 2 k + 1 in its fast part.
template <class T>
class MotorClock {
 public:
  MotorClock() = default;
  MotorClock(const RobotParameters<T>& p, int leg, double time_origin)
      : period_(p.period),
        duty_(p.duty),
        sweep_(p.sweep),
        offset_(p.offset),
        phase_(p.phase[static_cast<std::size_t>(leg)]),
        origin_(time_origin) {}

  /// The piece at time t of the run [s]; at a knot the one that begins there.
  int PieceAt(double t) const {
    constexpr double kSameInstant = 1e-12;
    const double c = (t + origin_) / Value(period_) + Value(phase_) + kSameInstant;
    const double turn = std::floor(c);
    return 2 * static_cast<int>(turn) + (c - turn < Value(duty_) ? 0 : 1);
  }
  /// The instant at which a piece ends [s].
  T End(int piece) const {
    const double turn = TurnOf(piece);
    const T along = IsSlow(piece) ? T(turn + duty_) : T(turn + 1.0);
    return (along - phase_) * period_ - origin_;
  }
  /// The reference angle [rad] at time t, and its rate [rad/s], by the formula of a piece.
  T Angle(int piece, const T& t) const {
    const double turn = TurnOf(piece);
    const T s = (t + origin_) / period_ + phase_ - turn;
    const T whole = offset_ - 2.0 * std::numbers::pi * turn;
    if (IsSlow(piece)) return whole + sweep_ * (0.5 - s / duty_);
    return whole - 0.5 * sweep_ - Rest() * (s - duty_) / (1.0 - duty_);
  }
  T Rate(int piece) const {
    return IsSlow(piece) ? T(-sweep_ / (duty_ * period_)) : T(-Rest() / ((1.0 - duty_) * period_));
  }

 private:
  static bool IsSlow(int piece) { return (piece & 1) == 0; }
  static int TurnOf(int piece) { return (piece - (piece & 1)) / 2; }
  T Rest() const { return 2.0 * std::numbers::pi - sweep_; }

  T period_{1.0}, duty_{0.5}, sweep_{1.0}, offset_{0.0}, phase_{0.0};
  double origin_ = 0.0;
};

}  // namespace hoplab
