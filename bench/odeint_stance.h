#pragma once

#include <array>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <limits>

#include "model/hybrid/hybrid_system.h"
#include "model/integrators/integrator_options.h"
#include "model/laws/leg_load.h"

namespace hoplab::bench {

/// A stance as a peer computed it.
struct PeerStance {
  double liftoff_time = std::numeric_limits<double>::quiet_NaN();  // s since touch-down
  long rhs_calls = 0;
  long guard_calls = 0;
};

/// One stance by Boost.Odeint as its manual would have it: runge_kutta_dopri5 with step control and
/// dense output, and the lift-off (chord force back at zero) by bisection on the dense output down
/// to 1e-12 s. Right-hand side and guard are those of `mechanism`, the mechanism our own runs use;
/// its construction is not part of the stance. `body` is (x, y, vx, vy) at touch-down.
inline PeerStance OdeintStance(HybridSystem<double>& mechanism, const std::array<double, 4>& body,
                               const IntegratorOptions& options) {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, kLegStateSize>;
  constexpr double kTimeTolerance = 1e-12;  // s
  constexpr double kLongestStance = 1.0;    // s

  PeerStance out;
  State z{body[0], body[1], body[2], body[3], 0.0};
  const Mode mode = mechanism.Reset(Mode::kFlight, 0, 0.0, z.data()).next;
  const auto rhs = [&](const State& y, State& dy, double t) {
    ++out.rhs_calls;
    mechanism.Derivative(mode, t, y.data(), dy.data());
  };
  const auto chord_force = [&](double t, const State& y) {
    ++out.guard_calls;
    std::array<double, kMaxGuards> g;
    mechanism.Guards(mode, t, y.data(), g.data());
    return g[0];
  };

  auto stepper = odeint::make_dense_output(options.absolute_tolerance, options.relative_tolerance,
                                           odeint::runge_kutta_dopri5<State>());
  stepper.initialize(z, 0.0, mechanism.FirstStep(mode, z.data()));
  while (stepper.current_time() < kLongestStance) {
    const auto [begin, end] = stepper.do_step(rhs);
    if (chord_force(end, stepper.current_state()) >= 0.0) continue;
    double a = begin, b = end;
    State inside;
    while (b - a > kTimeTolerance) {
      const double middle = 0.5 * (a + b);
      stepper.calc_state(middle, inside);
      (chord_force(middle, inside) >= 0.0 ? a : b) = middle;
    }
    out.liftoff_time = 0.5 * (a + b);
    return out;
  }
  return out;
}

}  // namespace hoplab::bench
