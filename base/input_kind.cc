#include "base/input_kind.h"

#include <cstddef>

namespace hoplab {

const InputInfo& InfoOf(InputKind kind) {
  static const std::array<InputInfo, kInputKinds> kRows = {{
      {"hip_torque_N_m", "hip_torque", Within(1e6, "N m")},
      {"leg_angle_rad", "leg_angle", Within(1e3, "rad")},
      {"body_force_x_N", "body_force_x", Within(1e6, "N")},
      {"body_force_y_N", "body_force_y", Within(1e6, "N")},
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
