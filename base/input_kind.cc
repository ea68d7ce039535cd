#include "base/input_kind.h"

#include <cstddef>

namespace hoplab {

const InputInfo& InfoOf(InputKind kind) {
  static const std::array<InputInfo, kInputKinds> kRows = {{
      {"hip_torque_N_m", "hip_torque", Within(1e6, "N m")},
      {"leg_angle_rad", "leg_angle", Within(1e3, "rad")},
      {"body_force_x_N", "body_force_x", Within(1e6, "N")},
      {"body_force_y_N", "body_force_y", Within(1e6, "N")},
      {"hip_torque_1_N_m", "hip_torque_1", Within(1e6, "N m")},
      {"hip_torque_2_N_m", "hip_torque_2", Within(1e6, "N m")},
      {"hip_torque_3_N_m", "hip_torque_3", Within(1e6, "N m")},
      {"hip_torque_4_N_m", "hip_torque_4", Within(1e6, "N m")},
      {"leg_angle_1_rad", "leg_angle_1", Within(1e3, "rad")},
      {"leg_angle_2_rad", "leg_angle_2", Within(1e3, "rad")},
      {"leg_angle_3_rad", "leg_angle_3", Within(1e3, "rad")},
      {"leg_angle_4_rad", "leg_angle_4", Within(1e3, "rad")},
  }};
  return kRows[static_cast<std::size_t>(kind)];
}

std::vector<std::string> InputKeys() {
  std::vector<std::string> keys;
  for (const InputKind kind : kAllInputs) keys.emplace_back(InfoOf(kind).key);
  return keys;
}

std::optional<InputKind> InputFromKey(std::string_view key) {
  for (const InputKind kind : kAllInputs)
    if (key == InfoOf(kind).key) return kind;
  return std::nullopt;
}

}  // namespace hoplab
