#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/hybrid/automaton.h"
#include "model/jet.h"

namespace hoplab {

/// Flight under constant acceleration, in closed form. The body, state (x, y, vx, vy, ...), meets
/// the ground where its height is `contact_height`: guard 0; its apex is guard 1. A body that flies
/// below that height, its leg not placed, falls until its height is `floor`: guard 2.
template <class T>
struct BallisticFlight {
  T ax{0.0}, ay{0.0};                                       // [m/s^2]
  T contact_height{0.0};                                    // [m]
  double floor = -std::numeric_limits<double>::infinity();  // [m]
  /// A second body falls beside the first, its state behind that of the first.
  bool is_pair = false;

  /// Changes the state `z` into the one `dt` later (earlier, if negative).
  void Advance(const T& dt, T* z) const {
    AdvanceBody(dt, z);
    if (is_pair) AdvanceBody(dt, z + 4);
  }

  /// The next event from state `z` at time `t`, if it comes before `end`.
  GuardCrossing Next(double t, double end, const T* z) const {
    const double a = Value(ay), vy = Value(z[3]), above = Value(z[1] - contact_height);
    // Armed like any guard: what rounding leaves of vy at an apex is not another apex.
    const double to_apex = vy > kAtZero && a < 0.0 ? -vy / a : kNever;
    const double to_contact = ToContact(a, vy, above);
    const double to_floor = ToContact(a, vy, Value(z[1]) - floor);
    const double first = std::min({to_apex, to_contact, to_floor});
    if (!(first < end - t)) return {-1, end};
    return {to_apex == first ? 1 : to_contact == first ? 0 : 2, t + first};
  }

 private:
  void AdvanceBody(const T& dt, T* z) const {
    z[0] += dt * (z[2] + 0.5 * ax * dt);
    z[1] += dt * (z[3] + 0.5 * ay * dt);
    z[2] += ax * dt;
    z[3] += ay * dt;
  }

  static constexpr double kNever = std::numeric_limits<double>::infinity();

  // Time until the body comes down through a height it is `above` of: the later root, in the form
  // that does not cancel. Never where it is below and sinks.
  static double ToContact(double a, double vy, double above) {
    if (above == std::numeric_limits<double>::infinity()) return kNever;
    if (above < 0.0 && vy <= 0.0 && a <= 0.0) return kNever;
    if (a == 0.0) return vy < 0.0 ? -above / vy : kNever;
    const double square = vy * vy - 2.0 * a * above;
    if (square < 0.0) return kNever;
    const double root = std::sqrt(square);
    if (a > 0.0) return vy < 0.0 && above > 0.0 ? 2.0 * above / (root - vy) : kNever;
    return vy >= 0.0 ? -(vy + root) / a : 2.0 * above / (root - vy);
  }
};

}  // namespace hoplab
