#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "tests/support/requests.h"

namespace hoplab::testing {

inline constexpr Law kLegLaws[] = {Law::kThesis, Law::kNoSlip, Law::kConsistent,
                                   Law::kLargeDeflection, Law::kStraightLeg};

/// Chord length of the unloaded leg to its toe [m].
inline double ToeChord(const SimulationRequest& q) {
  return q.law == Law::kStraightLeg ? q.parameters.l0 : 2.0 * q.parameters.r;
}

/// Puts a mass on the toe, placed by a torque with critical damping of frequency `placing` [rad/s]
/// of a toe on the unloaded leg.
inline SimulationRequest WithToeMass(SimulationRequest q, double mass, double placing) {
  const double inertia = mass * ToeChord(q) * ToeChord(q);
  q.parameters.m_toe = mass;
  q.parameters.kp_place = inertia * placing * placing;
  q.parameters.kd_place = 2.0 * inertia * placing;
  return q;
}

/// A leg of 1 kg with 20 g at its toe; a straight one of the same size and stiffness.
inline SimulationRequest ToeMassRequest(Law law) {
  SimulationRequest q = ThickLegRequest(law == Law::kStraightLeg ? Law::kConsistent : law);
  q.law = law;
  if (law == Law::kStraightLeg) {
    q.parameters.k = 2000.0;
    q.parameters.l0 = 0.18;
    q.parameters.theta_td = Degrees(12.0);
  }
  return WithToeMass(q, 0.02, 100.0);
}

/// Two bodies in free fall joined along and across the line between them, stepped by the classical
/// Runge-Kutta method from Newton's equations: M40 written once more, with what it dissipates.
struct TwoBodies {
  double m, m_toe, g;
  std::function<double(double l)> spring;  // F_el [N]
  double d, kp, kd, theta_td;

  /// (x, y, vx, vy, X, Y, VX, VY, dissipated [J]).
  using State = std::array<double, 9>;

  State Rate(const State& z) const {
    const double dx = z[0] - z[4], dy = z[1] - z[5], l = std::hypot(dx, dy);
    const double ex = dx / l, ey = dy / l, nx = ey, ny = -ex;
    const double rvx = z[2] - z[6], rvy = z[3] - z[7];
    const double stretching = rvx * ex + rvy * ey, across = rvx * nx + rvy * ny;
    const double theta = std::atan2(-dx, dy), turning = -across / l;
    const double along = spring(l) - d * stretching;
    const double torque = kd * turning - kp * (theta_td - theta);
    const double fx = along * ex + torque / l * nx, fy = along * ey + torque / l * ny;
    return {z[2],
            z[3],
            fx / m,
            fy / m - g,
            z[6],
            z[7],
            -fx / m_toe,
            -fy / m_toe - g,
            d * stretching * stretching + kd * turning * turning};
  }
  State After(State z, double time, int steps) const {
    const double h = time / steps;
    const auto moved = [](const State& z, const State& k, double by) {
      State out;
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = z[i] + by * k[i];
      return out;
    };
    for (int i = 0; i < steps; ++i) {
      const State a = Rate(z), b = Rate(moved(z, a, h / 2)), c = Rate(moved(z, b, h / 2)),
                  e = Rate(moved(z, c, h));
      for (std::size_t j = 0; j < z.size(); ++j)
        z[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + e[j]);
    }
    return z;
  }
};

/// The request ended `seconds` after its first event of that kind.
inline SimulationRequest EndedAfter(SimulationRequest q, EventKind kind, double seconds,
                                    int number = 1) {
  q.max_hops = 0;
  for (const Event& e : Simulate(q).events) {
    if (e.kind == kind && --number == 0) {
      q.horizon = e.time + seconds;
      return q;
    }
  }
  q.horizon = std::nan("");
  return q;
}

}  // namespace hoplab::testing
