#include "base/mechanism_kind.h"

#include <cstddef>

namespace hoplab {

const char* NameOf(MechanismKind kind) {
  static constexpr const char* kNames[] = {"c_leg", "straight_leg", "ball", "robot"};
  return kNames[static_cast<std::size_t>(kind)];
}

const char* NameOf(LiftoffRule rule) {
  static constexpr const char* kNames[] = {"zero_force", "rest_length"};
  return kNames[static_cast<std::size_t>(rule)];
}

const char* NameOf(MotorControl control) {
  static constexpr const char* kNames[] = {"locked", "held", "clock", "recorded"};
  return kNames[static_cast<std::size_t>(control)];
}

}  // namespace hoplab
