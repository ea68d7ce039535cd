#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.h"

namespace hoplab {

/// What a logged column can drive in a simulation: the hip torque in place of the controller's, the
/// leg angle commanded in flight, a force on the body along the axes of world W; of a robot the
/// torque a motor is told, or the angle its controller turns it to, motor 1 the hindmost.
enum class InputKind {
  kHipTorque,
  kLegAngle,
  kBodyForceX,
  kBodyForceY,
  kHipTorque1,
  kHipTorque2,
  kHipTorque3,
  kHipTorque4,
  kLegAngle1,
  kLegAngle2,
  kLegAngle3,
  kLegAngle4
};
inline constexpr std::array kAllInputs = {
    InputKind::kHipTorque,  InputKind::kLegAngle,   InputKind::kBodyForceX, InputKind::kBodyForceY,
    InputKind::kHipTorque1, InputKind::kHipTorque2, InputKind::kHipTorque3, InputKind::kHipTorque4,
    InputKind::kLegAngle1,  InputKind::kLegAngle2,  InputKind::kLegAngle3,  InputKind::kLegAngle4};
inline constexpr int kInputKinds = kAllInputs.size();

/// A set of kinds, one bit each.
using InputSet = unsigned;
constexpr InputSet BitOf(InputKind kind) { return 1u << static_cast<unsigned>(kind); }
inline constexpr InputSet kEveryInput = (1u << kInputKinds) - 1;

/// The kind of a motor from that of motor 1; motors count from 0.
constexpr InputKind OfMotor(InputKind first, int motor) {
  return static_cast<InputKind>(static_cast<int>(first) + motor);
}
/// The motor of a robot that a kind drives, from 0; -1 if it is none's.
constexpr int MotorOf(InputKind kind) {
  if (kind >= InputKind::kLegAngle1)
    return static_cast<int>(kind) - static_cast<int>(InputKind::kLegAngle1);
  if (kind >= InputKind::kHipTorque1)
    return static_cast<int>(kind) - static_cast<int>(InputKind::kHipTorque1);
  return -1;
}

/// Kinds that share a delay and a scale as effects change them: a motor's is of the family of the
/// single hip's.
inline constexpr int kInputFamilies = 4;
constexpr InputKind FamilyOf(InputKind kind) {
  if (kind >= InputKind::kLegAngle1) return InputKind::kLegAngle;
  return kind >= InputKind::kHipTorque1 ? InputKind::kHipTorque : kind;
}
/// All kinds of a family.
constexpr InputSet BitsOfFamily(InputKind family) {
  InputSet bits = 0;
  for (const InputKind kind : kAllInputs)
    if (FamilyOf(kind) == family) bits |= BitOf(kind);
  return bits;
}

struct InputInfo {
  const char* key;   // "hip_torque_N_m": of the file, and its column unless another one is named
  const char* name;  // "hip_torque", as in input.hip_torque.delay
  Range range;       // what a sample may be, with its unit
};
const InputInfo& InfoOf(InputKind kind);
std::vector<std::string> InputKeys();
std::optional<InputKind> InputFromKey(std::string_view key);

}  // namespace hoplab
