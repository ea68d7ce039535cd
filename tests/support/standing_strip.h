#pragma once

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <numbers>

namespace hoplab::testing {

/// A strip of E I = 1, length pi and mean rest curvature 1 that stands on a sole `h` with the arc
/// `phi` between its hip and the place where its tangent is level; the ground's force `f` runs
/// through the hip. Its rest curvature falls evenly from 1 + chi at the hip to 1 - chi at its end.
/// By shooting.
struct StandingStrip {
  double chord, lead;  // from the ground to the hip; its share along the ground
  double turned;       // angle of the tangent at the hip against that at the contact [rad]
  double by_arc;       // of an even curvature: how the energy goes with the arc, over f (1 + h)

  StandingStrip(double phi, double f, double h, double chi = 0.0) {
    namespace odeint = boost::numeric::odeint;
    using State = std::array<double, 3>;  // x, y, angle of the tangent, from the contact
    State hip;
    const auto miss = [&](double lean) {
      const double along = std::sin(lean), up = std::cos(lean);
      hip = {0.0, h, 0.0};
      odeint::runge_kutta_fehlberg78<State> step;
      constexpr int kSteps = 200;
      for (int i = 0; i < kSteps; ++i)
        step.do_step(
            [&](const State& s, State& d, double at) {
              const double rest = 1.0 + chi * (1.0 - 2.0 * (phi - at) / std::numbers::pi);
              d = {std::cos(s[2]), std::sin(s[2]), rest + f * (s[0] * up - s[1] * along)};
            },
            hip, phi * i / kSteps, phi / kSteps);
      return hip[0] * up - hip[1] * along;
    };
    double before = 0.5 * (std::numbers::pi - phi), lean = before + 1e-3,
           miss_before = miss(before);
    for (int round = 0; round < 50; ++round) {
      const double now = miss(lean);
      if (now == miss_before) break;
      const double next = lean - now * (lean - before) / (now - miss_before);
      before = lean;
      miss_before = now;
      lean = next;
      if (std::abs(lean - before) < 1e-14) break;
    }
    miss(lean);
    chord = std::hypot(hip[0], hip[1]);
    lead = std::sin(lean);
    turned = hip[2];
    // A piece more of the arc moves the ground's point by itself and by what it turns the sole, and
    // holds what it is bent.
    by_arc = lead * (1.0 + h - 0.5 * h * h * f * lead) / (1.0 + h);
  }
};

}  // namespace hoplab::testing
