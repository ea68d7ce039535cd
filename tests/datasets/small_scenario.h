#pragma once

#include <string>

#include "datasets/read_scenario.h"
#include "tests/datasets/small_dataset.h"
#include "tests/support/input_error_of.h"

namespace hoplab::testing {

/// Every block that a scenario may have; lines as numbered.
inline const char* const kSmallScenario =
    "format: hoplab-scenario/1\n"  // 1
    "name: controlled-hopping\n"   // 2
    "law: large_deflection\n"      // 3
    "mechanism: {type: c_leg, body_mass_kg: 1.0, gravity_m_per_s2: 9.81, leg: {rest_radius_m: "
    "0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, damping_N_s_per_m: 3.0}}\n"
    "controller: {kp_N_s: 4.0, v_des_m_per_s: 1.8}\n"                            // 5
    "touchdown_angle_deg: 40\n"                                                  // 6
    "initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 1.0, vy_m_per_s: 0}\n"              // 7
    "stop: {time_s: 15, hops: 60}\n"                                             // 8
    "effects: {air_drag: {c_drag: 0.05}}\n"                                      // 9
    "search:\n"                                                                  // 10
    "  over: {touchdown_angle_deg: [15, 60], controller.kp_N_s: [0.5, 12]}\n"    // 11
    "  objective: convergence_time\n"                                            // 12
    "  constraints: {min_speed_m_per_s: 0.5, max_torque_N_m: 10}\n"              // 13
    "  budget: 2000\n"                                                           // 14
    "sweep:\n"                                                                   // 15
    "  grid: {mechanism.leg.E_Pa: [21.1e9, 22.0e9], initial.y_m: [0.2, 0.3]}\n"  // 16
    "  outputs: [convergence_time_s, stiffness_min_N_per_m]\n"                   // 17
    "dataset:\n"                                                                 // 18
    "  name: made\n"                                                             // 19
    "  sample_rate_hz: 500\n"                                                    // 20
    "  channels: {body_x_m: {sigma: 0.001}}\n"                                   // 21
    "  trials:\n"                                                                // 22
    "    - {role: train, touchdown_angle_deg: 25}\n"                             // 23
    "    - {role: test, initial: {y_m: 0.25}, controller: null}\n";              // 24

inline ScenarioDocument Document(const std::string& text = kSmallScenario) {
  return ScenarioDocument::FromText(text, "s.yaml");
}

inline std::string ScenarioErrorWith(const std::string& from, const std::string& to) {
  return InputErrorOf([&] { Document(Replace(kSmallScenario, from, to)).Read(); });
}

inline std::string ErrorWithSet(const std::string& option) {
  return InputErrorOf([&] {
    ScenarioDocument document = Document();
    document.SetFromOption(option);
    document.Read();
  });
}

}  // namespace hoplab::testing
