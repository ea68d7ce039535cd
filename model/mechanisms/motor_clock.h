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
        phase_(p.phase[static_cast<std::size_t>(leg)]),
        origin_(time_origin) {
    const T turned = origin_ / period_ + phase_;               // at the run's start
    const auto line = [&](const T& angle, const T& by_turn) {  // by_turn: of the clock
      return Line{angle - by_turn * turned, by_turn - 2.0 * std::numbers::pi, -by_turn / period_};
    };
    const T slow = p.sweep / duty_, fast = (2.0 * std::numbers::pi - p.sweep) / (1.0 - duty_);
    slow_ = line(p.offset + 0.5 * p.sweep, slow);
    fast_ = line(p.offset - 0.5 * p.sweep + fast * duty_, fast);
  }

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
    const Line& line = LineOf(piece);
    return line.start + static_cast<double>(TurnOf(piece)) * line.by_turn + line.rate * t;
  }
  const T& Rate(int piece) const { return LineOf(piece).rate; }

 private:
  /// A piece of every turn: from the angle at time 0 in turn 0 on.
  struct Line {
    T start{0.0}, by_turn{0.0}, rate{0.0};  // [rad], [rad], [rad/s]
  };
  static bool IsSlow(int piece) { return (piece & 1) == 0; }
  static int TurnOf(int piece) { return (piece - (piece & 1)) / 2; }
  const Line& LineOf(int piece) const { return IsSlow(piece) ? slow_ : fast_; }

  T period_{1.0}, duty_{0.5}, phase_{0.0};
  Line slow_, fast_;
  double origin_ = 0.0;
};

}  // namespace hoplab
