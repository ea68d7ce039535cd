#pragma once

#include <string>
#include <utility>
#include <vector>

#include "datasets/read_scenario.h"

namespace hoplab::testing {

/// A robot of 3 kg on two half circles of 9 cm, held and dropped; three trials to learn from, which
/// lower first the one leg, then the other, and one held out. `set`: keys and their texts over it.
inline Scenario RobotDrops(const std::vector<std::pair<std::string, std::string>>& set = {}) {
  ScenarioDocument document = ScenarioDocument::FromText(R"(format: hoplab-scenario/1
name: robot-drops
mechanism:
  type: robot
  body_mass_kg: 3
  pitch_inertia_kg_m2: 0.05
  gravity_m_per_s2: 9.81
  friction: 1
  motor: {rotor_inertia_kg_m2: 0.001, kp_N_m_per_rad: 60, kd_N_m_s_per_rad: 0.8, torque_limit_N_m: 15}
  leg: {rest_radius_m: 0.09, E_Pa: 22.0e9, second_moment_m4: 1.8355e-10, material_damping_s: 0.0004}
  legs: [{hip_m: [-0.12, 0]}, {hip_m: [0.12, 0]}]
controller: {type: held, angles_rad: [0.6, 0.4]}
initial: {x_m: 0, y_m: 0.25, vx_m_per_s: 0.3, vy_m_per_s: 0, pitch_rad: 0, pitch_rate_rad_per_s: 0}
stop: {time_s: 0.5}
dataset:
  channels:
    body_x_m: {sigma: 0.0005}
    body_y_m: {sigma: 0.0005}
    body_pitch_rad: {sigma: 0.001}
    leg_angle_1_rad: {sigma: 0.001}
    leg_angle_2_rad: {sigma: 0.001}
    hip_torque_1_N_m: {sigma: 0.005}
    hip_torque_2_N_m: {sigma: 0.005}
  initial_sigma: {x_m: 0.002, y_m: 0.002, vx_m_per_s: 0.02, vy_m_per_s: 0.02, pitch_rad: 0.005, pitch_rate_rad_per_s: 0.05}
  trials:
    - role: train
    - {role: train, controller: {type: held, angles_rad: [0.4, 0.5]}}
    - {role: train, controller: {type: held, angles_rad: [0.3, 0.65]}}
    - {role: test, initial: {x_m: 0, y_m: 0.27, vx_m_per_s: 0.1, vy_m_per_s: 0, pitch_rad: 0.05, pitch_rate_rad_per_s: 0}}
)",
                                                         "robot-drops.yaml");
  for (const auto& [key, text] : set) document.Set(key, text);
  return document.Read();
}

}  // namespace hoplab::testing
