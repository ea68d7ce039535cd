#pragma once

#include "datasets/read_scenario.h"
#include "fitting/generate.h"
#include "fitting/problem.h"

namespace hoplab::testing {

/// A robot of 3 kg whose two half circles a clock turns in phase, its mass `com_x` ahead of the
/// middle [m]; four trials of `duration` [s] to learn from, two held out. What the dataset says of
/// it has the mass in the middle and a modulus of 24 in place of 22 GPa.
inline Dataset RobotPronks(double com_x, double duration) {
  ScenarioDocument document = ScenarioDocument::FromText(R"(format: hoplab-scenario/1
name: robot-pronks
mechanism:
  type: robot
  body_mass_kg: 3
  pitch_inertia_kg_m2: 0.03707
  centre_of_mass_m: [0, 0]
  gravity_m_per_s2: 9.81
  friction: 1
  motor: {rotor_inertia_kg_m2: 0.001, kp_N_m_per_rad: 47.35, kd_N_m_s_per_rad: 1.662, torque_limit_N_m: 15}
  leg: {rest_radius_m: 0.09, E_Pa: 22.0e9, second_moment_m4: 1.8355e-10, material_damping_s: 0.0004}
  legs: [{hip_m: [-0.12, 0]}, {hip_m: [0.12, 0]}]
controller: {type: clock, period_s: 0.40, duty: 0.5624, sweep_rad: 1.25, offset_rad: 0.4181, phases: [0, 0]}
initial: {x_m: 0, y_m: 0.222, vx_m_per_s: 0.72, vy_m_per_s: 0, pitch_rad: 0.03, pitch_rate_rad_per_s: 0}
stop: {time_s: 1}
dataset:
  channels:
    body_x_m: {sigma: 0.0005}
    body_y_m: {sigma: 0.0005}
    body_pitch_rad: {sigma: 0.001}
    leg_angle_1_rad: {sigma: 0.001}
    leg_angle_2_rad: {sigma: 0.001}
  initial_sigma: {x_m: 0.002, y_m: 0.002, vx_m_per_s: 0.02, vy_m_per_s: 0.02, pitch_rad: 0.005, pitch_rate_rad_per_s: 0.05}
  trials:
    - role: train
    - {role: train, initial: {x_m: 0, y_m: 0.213, vx_m_per_s: 0.76, vy_m_per_s: 0.02, pitch_rad: 0.045, pitch_rate_rad_per_s: 0.05}}
    - {role: train, initial: {x_m: 0, y_m: 0.226, vx_m_per_s: 0.69, vy_m_per_s: -0.02, pitch_rad: 0.015, pitch_rate_rad_per_s: -0.06}}
    - {role: train, initial: {x_m: 0, y_m: 0.219, vx_m_per_s: 0.74, vy_m_per_s: 0.01, pitch_rad: 0.05, pitch_rate_rad_per_s: 0}}
    - {role: test, initial: {x_m: 0, y_m: 0.217, vx_m_per_s: 0.70, vy_m_per_s: 0, pitch_rad: 0.02, pitch_rate_rad_per_s: -0.05}}
    - {role: test, initial: {x_m: 0, y_m: 0.223, vx_m_per_s: 0.73, vy_m_per_s: -0.01, pitch_rad: 0.04, pitch_rate_rad_per_s: 0.03}}
)",
                                                         "robot-pronks.yaml");
  document.Set("mechanism.centre_of_mass_m", "[" + std::to_string(com_x) + ", 0]");
  document.Set("stop.time_s", std::to_string(duration));
  Dataset dataset = GenerateDataset(document.Read(), {}).dataset;
  for (Trial& trial : dataset.trials) {
    trial.mechanism.robot.com_x_m = 0.0;
    trial.mechanism.robot.E_Pa = 24e9;
  }
  return dataset;
}

}  // namespace hoplab::testing
