#pragma once

#include <cstdint>
#include <numbers>

#include "fitting/generate.h"

namespace hoplab::testing {

/// True values behind the generated traces of the fitting tests.
struct HopTruth {
  double E_Pa = 22e9;
  double damping_N_s_per_m = 3.0;
};

/// Six train trials (and two test trials) of a half-circular leg: three passive hops, or ten
/// controlled ones (a passive leg falls before its tenth hop).
inline Scenario HopScenario(int hops, const HopTruth& truth = {}) {
  Scenario s;
  s.name = "generated-hops";
  s.law = "elastica";
  MechanismSpec& m = s.mechanism;
  m.type = MechanismKind::kCLeg;
  m.body_mass_kg = 1.0;
  m.gravity_m_per_s2 = 9.81;
  m.c_leg.rest_radius_m = 0.09;
  m.c_leg.E_Pa = truth.E_Pa;
  m.c_leg.G_Pa = 4e9;
  m.c_leg.second_moment_m4 = 0.03 * 0.0038 * 0.0038 * 0.0038 / 12.0;
  m.c_leg.area_m2 = 0.03 * 0.0038;
  m.c_leg.damping_N_s_per_m = truth.damping_N_s_per_m;
  s.stop.time_s = 30.0;
  s.stop.hops = hops;
  GenerateSpec& d = s.dataset.emplace();
  d.sample_rate_hz = 250.0;
  d.channels = {{Channel::kBodyX, 0.001}, {Channel::kBodyY, 0.001}};
  d.initial_sigma = StateSpec{0.002, 0.002, 0.02, 0.02};
  const double angles[] = {22, 24, 25, 26, 28, 30, 23, 27};
  const double heights[] = {0.30, 0.33, 0.28, 0.31, 0.34, 0.29, 0.32, 0.30};
  const double speeds[] = {1.2, 1.4, 1.3, 1.5, 1.6, 1.7, 1.4, 1.5};
  for (int i = 0; i < 8; ++i) {
    GenerateTrial t;
    t.role = i < 6 ? TrialRole::kTrain : TrialRole::kTest;
    t.file = (i < 6 ? "train-" : "test-") + std::to_string(i + 1) + ".csv";
    t.touchdown_angle_rad = angles[i] * std::numbers::pi / 180.0;
    t.initial = StateSpec{0.0, heights[i], speeds[i], 0.0};
    if (hops > 3) t.controller = ControllerSpec{2.0 + 0.3 * i, 1.8, std::nullopt};
    t.mechanism = m;
    d.trials.push_back(t);
  }
  return s;
}

/// Its traces with 1 mm noise, by another integrator than fits use.
inline Dataset HopDataset(int hops, std::uint64_t seed, const HopTruth& truth = {}) {
  GenerateOptions options;
  options.seed = seed;
  return GenerateDataset(HopScenario(hops, truth), options).dataset;
}

}  // namespace hoplab::testing
