#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hoplab::testing {

/// A ball in air that moves with `wind` [m/s] along the ground: F = -drag |v - w| (v - w), bounces
/// by a restitution and a loss along the ground where its centre is at `radius`. Air of mass
/// `displaced` carries it, so that it weighs `mass` there, and half as much moves along. By small
/// steps of Heun's rule, an independent reference.
struct BallInMovingAir {
  double drag, wind, mass, g;  // N s^2/m^2, m/s, kg, m/s^2
  double displaced = 0.0;      // kg
  double radius = 0.02, restitution = 0.85, tangential_loss = 0.1;
  double friction = 0.0;  // of the ground on a ball that slides through its bounce

  using State = std::array<double, 4>;  // x, y [m], vx, vy [m/s]

  /// The state at each time [s], which rise from 0.
  std::vector<State> At(const std::vector<double>& times, State s) const {
    constexpr double kStep = 1e-4;
    std::vector<State> states;
    double now = 0.0;
    for (const double time : times) {
      const int steps = std::max(1, static_cast<int>(std::ceil((time - now) / kStep)));
      const double h = (time - now) / steps;
      for (int i = 0; i < steps && h > 0.0; ++i) s = AfterStep(s, h);
      states.push_back(s);
      now = time;
    }
    return states;
  }

 private:
  State Rate(const State& s) const {
    const double ux = s[2] - wind, moved = mass + 1.5 * displaced;
    const double factor = drag * std::hypot(ux, s[3]) / moved;
    return {s[2], s[3], -factor * ux, -factor * s[3] - g * mass / moved};
  }
  State Heun(const State& s, double h) const {
    const State a = Rate(s);
    State ahead = s, next = s;
    for (std::size_t k = 0; k < 4; ++k) ahead[k] += h * a[k];
    const State b = Rate(ahead);
    for (std::size_t k = 0; k < 4; ++k) next[k] += 0.5 * h * (a[k] + b[k]);
    return next;
  }
  // Up to the ground, by halving the step, and on.
  State AfterStep(const State& s, double h) const {
    const State next = Heun(s, h);
    if (next[1] >= radius || next[3] >= 0.0) return next;
    double before = 0.0, after = h;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (before + after);
      (Heun(s, middle)[1] >= radius ? before : after) = middle;
    }
    State at = Heun(s, before);
    at[2] *= 1.0 - tangential_loss;
    at[2] -= std::copysign(friction * (1.0 + restitution) * std::abs(at[3]), at[2]);
    at[3] *= -restitution;
    return Heun(at, h - before);
  }
};

}  // namespace hoplab::testing
