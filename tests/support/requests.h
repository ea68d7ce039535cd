#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "model/simulate.h"
#include "tests/support/tolerances.h"

namespace hoplab::testing {

inline double Degrees(double deg) { return deg * std::numbers::pi / 180.0; }

/// A C-leg of 90 mm radius on 1 kg. Its section is thick (30 mm x 20 mm of a soft material), so
/// that normal and shear force, G, A and kappa, are seen in the motion.
inline SimulationRequest ThickLegRequest(Law law) {
  SimulationRequest q;
  q.law = law;
  q.parameters.m = 1.0;
  q.parameters.r = 0.09;
  q.parameters.E = 1.35e8;
  q.parameters.G = 0.5e8;
  q.parameters.I = 2e-8;
  q.parameters.A = 6e-4;
  q.parameters.d = 3.0;
  q.parameters.theta_td = Degrees(30.0);
  q.initial = {0.0, 0.25, 1.0, -0.1};
  q.horizon = 5.0;
  q.max_hops = 1;
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  return q;
}

/// A strip leg: 30 mm x 3.66 mm glass fibre, k(pi) about 2350 N/m, no damping.
inline SimulationRequest StripLegRequest(Law law, double theta_td) {
  SimulationRequest q;
  q.law = law;
  q.parameters.m = 1.0;
  q.parameters.r = 0.09;
  q.parameters.E = 22e9;
  q.parameters.G = 4e9;
  q.parameters.I = 0.03 * std::pow(0.003658, 3) / 12.0;
  q.parameters.A = 0.03 * 0.003658;
  q.parameters.theta_td = theta_td;
  q.initial = {0.0, 0.3, 1.0, 0.0};
  q.horizon = 5.0;
  q.max_hops = 1;
  return q;
}

/// The straight leg whose steady hop is known: m = 100 kg, k = 1e4 N/m, l0 = 1 m, g = 10 m/s^2,
/// touch-down at 5 deg, no damping.
inline SimulationRequest SteadyStraightLeg() {
  SimulationRequest q;
  q.law = Law::kStraightLeg;
  q.parameters.m = 100.0;
  q.parameters.k = 1e4;
  q.parameters.l0 = 1.0;
  q.parameters.g = 10.0;
  q.parameters.theta_td = Degrees(5.0);
  q.initial = {0.0, 1.238312718076982, 0.513806075894484, 0.0};
  q.horizon = 5.0;
  q.max_hops = 1;
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  return q;
}

inline SimulationRequest BallRequest() {
  SimulationRequest q;
  q.law = Law::kBall;
  q.parameters.m = 0.2;
  q.parameters.radius = 0.05;
  q.parameters.restitution = 0.8;
  q.parameters.tangential_loss = 0.1;
  q.initial = {0.1, 1.2, 0.7, 0.4};
  q.horizon = 4.0;
  return q;
}

/// "touchdown rolling_to_toe liftoff apex".
inline std::string EventNames(const Trajectory& run) {
  std::string names;
  for (const Event& e : run.events) {
    if (!names.empty()) names += ' ';
    names += NameOf(e.kind);
  }
  return names;
}

/// `count` evenly spaced times over the first `end` seconds, the ends left out.
inline std::vector<double> EvenTimes(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(end * (i + 0.5) / count);
  return times;
}

inline constexpr Law kCLegLaws[] = {Law::kThesis, Law::kNoSlip, Law::kConsistent,
                                    Law::kLargeDeflection, Law::kElastica};

}  // namespace hoplab::testing
