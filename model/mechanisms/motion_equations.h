#pragma once

#include <array>

#include "model/mechanisms/leg_form.h"
#include "model/robot_parameters.h"

namespace hoplab {

/// A number of every motion of a robot: of its reference point, its pitch, its motors, and of each
/// leg its own.
template <class T>
struct AllMotions {
  T x{0.0}, y{0.0}, pitch{0.0};
  std::array<T, kMaxLegs> motor{}, own{};
};

/// The equations of motion of a robot whose legs have mass (M83, M92) with the masses as they are
/// now. Each leg's own motion and motor are eliminated, each by its own row. Solved for numbers of
/// any type.
class MotionEquations {
 public:
  /// The body's `mass` along the ground and across it.
  MotionEquations(const Vector2<double>& mass, double com_x, double com_y, double pitch_inertia)
      : a_{{mass.x, 0.0, -mass.x * com_y},
           {0.0, mass.y, mass.y * com_x},
           {-mass.x * com_y, mass.y * com_x,
            pitch_inertia + mass.y * (com_x * com_x) + mass.x * (com_y * com_y)}} {}

  /// The next leg, its hip at (x, y) from the reference point, its `mass` by the motion of hip,
  /// base and its own; `own` is the row of that motion, null of a leg that has none; `hub` the
  /// inertia of the motor, null of one that is locked.
  void Add(double x, double y, const double (&mass)[4][4], const LegMotion<double>* own,
           const double* hub) {
    Leg& leg = leg_[legs_++];
    leg.x = x;
    leg.y = y;
    double e[3][3];
    leg.has_own = own != nullptr;
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) e[j][k] = mass[j][k];
    if (own) {
      leg.own = *own;
      for (int j = 0; j < 3; ++j) {
        leg.by_own[j] = mass[j][3] / leg.own[3];
        for (int k = 0; k < 3; ++k) e[j][k] -= leg.by_own[j] * leg.own[k];
      }
    }
    // The pitch moves hip and base.
    const double base[3] = {e[0][2], e[1][2], e[2][2]};
    for (int j = 0; j < 3; ++j) e[j][2] += x * e[j][1] - y * e[j][0];
    leg.over = hub ? 1.0 / (*hub + base[2]) : 0.0;
    for (int j = 0; j < 3; ++j) {
      leg.motor[j] = e[2][j];
      leg.by_motor[j] = base[j] * leg.over;
    }
    leg.by_motor[2] += x * leg.by_motor[1] - y * leg.by_motor[0];
    for (int k = 0; k < 3; ++k) {
      a_[0][k] += e[0][k] - leg.by_motor[0] * leg.motor[k];
      a_[1][k] += e[1][k] - leg.by_motor[1] * leg.motor[k];
      a_[2][k] += x * e[1][k] - y * e[0][k] + e[2][k] - leg.by_motor[2] * leg.motor[k];
    }
  }
  /// Once all legs are there.
  void Eliminate() {
    for (int j = 0; j < 3; ++j) {
      over_[j] = 1.0 / a_[j][j];
      for (int k = j + 1; k < 3; ++k) {
        a_[k][j] *= over_[j];
        for (int l = j + 1; l < 3; ++l) a_[k][l] -= a_[k][j] * a_[j][l];
      }
    }
  }
  /// `holding`, if asked for: of each motor that is locked the moment that it takes.
  template <class T>
  AllMotions<T> Solve(const AllMotions<T>& sides, T* holding = nullptr) const {
    T right[3] = {sides.x, sides.y, sides.pitch};
    AllMotions<T> of;
    for (int i = 0; i < legs_; ++i) {
      const Leg& leg = leg_[i];
      of.motor[i] = sides.motor[i];
      if (leg.has_own) {
        const T& own = sides.own[i];
        right[0] -= leg.by_own[0] * own;
        right[1] -= leg.by_own[1] * own;
        right[2] -= (leg.x * leg.by_own[1] - leg.y * leg.by_own[0] + leg.by_own[2]) * own;
        of.motor[i] -= leg.by_own[2] * own;
      }
      for (int j = 0; j < 3; ++j) right[j] -= leg.by_motor[j] * of.motor[i];
    }
    right[1] -= a_[1][0] * right[0];
    right[2] -= a_[2][0] * right[0];
    right[2] -= a_[2][1] * right[1];
    of.pitch = right[2] * over_[2];
    of.y = (right[1] - a_[1][2] * of.pitch) * over_[1];
    of.x = (right[0] - a_[0][1] * of.y - a_[0][2] * of.pitch) * over_[0];
    for (int i = 0; i < legs_; ++i) {
      const Leg& leg = leg_[i];
      of.motor[i] -= leg.motor[0] * of.x + leg.motor[1] * of.y + leg.motor[2] * of.pitch;
      if (holding) holding[i] = of.motor[i];
      of.motor[i] *= leg.over;
      if (!leg.has_own) continue;
      of.own[i] = (sides.own[i] - leg.own[0] * (of.x - of.pitch * leg.y) -
                   leg.own[1] * (of.y + of.pitch * leg.x) - leg.own[2] * (of.pitch + of.motor[i])) *
                  (1.0 / leg.own[3]);
    }
    return of;
  }

 private:
  struct Leg {
    double x, y;
    bool has_own;
    LegMotion<double> own;
    double by_own[3];              // what of its own motion's row hip and base take
    double motor[3], by_motor[3];  // the motor's row, and what of it x, y and pitch take
    double over;
  };
  double a_[3][3], over_[3];
  Leg leg_[kMaxLegs];
  int legs_ = 0;
};

}  // namespace hoplab
