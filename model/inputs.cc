#include "model/inputs.h"

namespace hoplab {

std::string_view NameOf(InputKind kind) {
  static constexpr std::array<std::string_view, kInputKinds> kNames = {
      "hip_torque", "leg_angle", "body_force_x", "body_force_y"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view UnitOf(InputKind kind) {
  static constexpr std::array<std::string_view, kInputKinds> kUnits = {"N m", "rad", "N", "N"};
  return kUnits[static_cast<std::size_t>(kind)];
}

}  // namespace hoplab
