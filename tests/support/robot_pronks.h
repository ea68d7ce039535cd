#pragma once

#include <string>
#include <vector>

#include "fitting/generate.h"
#include "fitting/problem.h"
#include "tests/support/robot_drops.h"

namespace hoplab::testing {

/// The robot of RobotDrops with its two legs turned in phase by a clock, its mass `com_x` [m] ahead
/// of the middle; four trials of `duration` [s] to learn from, two held out, torques not compared.
/// What the dataset says of it has the mass in the middle, a modulus of 24 in place of 22 GPa, and
/// nothing of `effects`, a list as in a scenario.
inline Dataset RobotPronks(double com_x, double duration, const std::string& effects = "{}") {
  Scenario pronks = RobotDrops(
      {{"mechanism.pitch_inertia_kg_m2", "0.03707"},
       {"mechanism.centre_of_mass_m", "[" + std::to_string(com_x) + ", 0]"},
       {"mechanism.motor.kp_N_m_per_rad", "47.35"},
       {"mechanism.motor.kd_N_m_s_per_rad", "1.662"},
       {"controller",
        "{type: clock, period_s: 0.40, duty: 0.5624, sweep_rad: 1.25, offset_rad: 0.4181, "
        "phases: [0, 0]}"},
       {"initial",
        "{x_m: 0, y_m: 0.222, vx_m_per_s: 0.72, vy_m_per_s: 0, pitch_rad: 0.03, "
        "pitch_rate_rad_per_s: 0}"},
       {"stop.time_s", std::to_string(duration)},
       {"effects", effects},
       {"dataset.trials", R"([
    {role: train},
    {role: train, initial: {x_m: 0, y_m: 0.213, vx_m_per_s: 0.76, vy_m_per_s: 0.02, pitch_rad: 0.045, pitch_rate_rad_per_s: 0.05}},
    {role: train, initial: {x_m: 0, y_m: 0.226, vx_m_per_s: 0.69, vy_m_per_s: -0.02, pitch_rad: 0.015, pitch_rate_rad_per_s: -0.06}},
    {role: train, initial: {x_m: 0, y_m: 0.219, vx_m_per_s: 0.74, vy_m_per_s: 0.01, pitch_rad: 0.05, pitch_rate_rad_per_s: 0}},
    {role: test, initial: {x_m: 0, y_m: 0.217, vx_m_per_s: 0.70, vy_m_per_s: 0, pitch_rad: 0.02, pitch_rate_rad_per_s: -0.05}},
    {role: test, initial: {x_m: 0, y_m: 0.223, vx_m_per_s: 0.73, vy_m_per_s: -0.01, pitch_rad: 0.04, pitch_rate_rad_per_s: 0.03}}])"}});
  std::erase_if(pronks.dataset->channels,
                [](const ChannelSpec& c) { return NameOf(c.id).starts_with("hip_torque"); });
  Dataset dataset = GenerateDataset(pronks, {}).dataset;
  for (Trial& trial : dataset.trials) {
    trial.mechanism.robot.com_x_m = 0.0;
    trial.mechanism.robot.E_Pa = 24e9;
  }
  return dataset;
}

}  // namespace hoplab::testing
