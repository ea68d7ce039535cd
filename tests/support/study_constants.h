#pragma once

namespace hoplab::testing {

/// Constants for the published study that are not those of `experiments/published.yaml`, so that no
/// test depends on what was identified.
inline const char* const kStudyConstants =
    "format: hoplab-scenario/1\n"
    "name: made-up-study\n"
    "law: thesis\n"
    "mechanism: {type: c_leg, body_mass_kg: 3.0, gravity_m_per_s2: 9.81, leg: {rest_radius_m: "
    "0.1, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0034, damping_N_s_per_m: 0}}\n"
    "controller: {kp_N_s: 16, v_des_m_per_s: 1.8}\n"
    "touchdown_angle_deg: 40\n"
    "initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 1.1, vy_m_per_s: 0}\n"
    "stop: {time_s: 15}\n";

}  // namespace hoplab::testing
