#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "model/hybrid/event_location.h"
#include "model/jet.h"

namespace hoplab {

/// Flight under constant acceleration, in closed form. The body, state (x, y, vx, vy, ...), meets
/// the ground where its height is `contact_height`: guard 0; its apex is guard 1.
template <class T>
struct BallisticFlight {
  T ax, ay;          // [m/s^2]
  T contact_height;  // [m]

  /// Changes the state `z` into the one `dt` later (earlier, if negative).
  template <std::size_t kDim>
  void Advance(const T& dt, std::array<T, kDim>& z) const {
    z[0] += dt * (z[2] + 0.5 * ax * dt);
    z[1] += dt * (z[3] + 0.5 * ay * dt);
    z[2] += ax * dt;
    z[3] += ay * dt;
  }

  /// The next event from state `z` at time `t`, if it comes before `end`.
  Crossing Next(double t, double end, const T* z) const {
    const double a = Value(ay), vy = Value(z[3]), above = Value(z[1] - contact_height);
    // Armed like any guard: what rounding leaves of vy at an apex is not another apex.
    const double to_apex = vy > kAtZero && a < 0.0 ? -vy / a : kNever;
    const double to_contact = ToContact(a, vy, above);
    if (to_apex <= to_contact && to_apex < end - t) return {1, t + to_apex};
    if (to_contact < end - t) return {0, t + to_contact};
    return {-1, end};
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  // Time until the body comes down through its contact height: the later root, in the form that
  // does not cancel.
  static double ToContact(double a, double vy, double above) {
    if (a == 0.0) return vy < 0.0 ? -above / vy : kNever;
    const double square = vy * vy - 2.0 * a * above;
    if (square < 0.0) return kNever;
    const double root = std::sqrt(square);
    if (a > 0.0) return vy < 0.0 && above > 0.0 ? 2.0 * above / (root - vy) : kNever;
    return vy >= 0.0 ? -(vy + root) / a : 2.0 * above / (root - vy);
  }
};

}  // namespace hoplab
