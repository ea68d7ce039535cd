#include "tests/support/elastica.h"

#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>

namespace hoplab::testing {
namespace {

using State = std::array<double, 3>;  // along the chord, above it, tangent angle

// From one end to the middle, in units of the radius. Equilibrium: the curvature grows by the
// bending moment F h over EI, h the height above the chord.
State Middle(double arc, double load, double end_angle) {
  namespace odeint = boost::numeric::odeint;
  State s = {0.0, 0.0, end_angle};
  const auto rate = [&](const State& at, State& d, double) {
    d = {std::cos(at[2]), std::sin(at[2]), -(1.0 + load * at[1])};
  };
  // Steps of 1/60 of half the arc: the truncation error of order 8 is below rounding.
  constexpr int kSteps = 60;
  odeint::integrate_n_steps(odeint::runge_kutta_fehlberg78<State>(), rate, s, 0.0,
                            0.5 * arc / kSteps, kSteps);
  return s;
}

}  // namespace

PressedArc SolvePressedArc(double arc, double radius, double EI, double F) {
  const double load = F * radius * radius / EI;
  // By symmetry the tangent is along the chord in the middle.
  const auto miss = [&](double end_angle) { return Middle(arc, load, end_angle)[2]; };
  std::uintmax_t rounds = 200;
  const auto bracket =
      boost::math::tools::toms748_solve(miss, 0.5 * arc - 0.3, 0.5 * arc + 2.0,
                                        boost::math::tools::eps_tolerance<double>(52), rounds);
  const double end_angle = 0.5 * (bracket.first + bracket.second);
  return {2.0 * radius * Middle(arc, load, end_angle)[0], end_angle};
}

PressedArc SolveHeldArc(double arc, double radius, double EI, double F, double N) {
  namespace odeint = boost::numeric::odeint;
  const double press = F * radius * radius / EI, across = N * radius * radius / EI;
  // From the free end to the held one, which is to lie on the chord.
  const auto end = [&](double end_angle) {
    State s = {0.0, 0.0, end_angle};
    const auto rate = [&](const State& at, State& d, double) {
      d = {std::cos(at[2]), std::sin(at[2]), -(1.0 + press * at[1] + across * at[0])};
    };
    constexpr int kSteps = 120;
    odeint::integrate_n_steps(odeint::runge_kutta_fehlberg78<State>(), rate, s, 0.0, arc / kSteps,
                              kSteps);
    return s;
  };
  std::uintmax_t rounds = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      [&](double angle) { return end(angle)[1]; }, 0.5 * arc - 0.3, 0.5 * arc + 0.6,
      boost::math::tools::eps_tolerance<double>(52), rounds);
  const double end_angle = 0.5 * (bracket.first + bracket.second);
  return {radius * end(end_angle)[0], end_angle};
}

}  // namespace hoplab::testing
