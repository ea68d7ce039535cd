#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.h"

namespace hoplab {

/// What a logged column can drive in a simulation: the hip torque in place of the controller's, the
/// leg angle commanded in flight, a force on the body along the axes of world W.
enum class InputKind { kHipTorque, kLegAngle, kBodyForceX, kBodyForceY };
inline constexpr std::array kAllInputs = {InputKind::kHipTorque, InputKind::kLegAngle,
                                          InputKind::kBodyForceX, InputKind::kBodyForceY};
inline constexpr int kInputKinds = kAllInputs.size();

/// A set of kinds, one bit each.
using InputSet = unsigned;
constexpr InputSet BitOf(InputKind kind) { return 1u << static_cast<unsigned>(kind); }
inline constexpr InputSet kEveryInput = (1u << kInputKinds) - 1;

struct InputInfo {
  const char* key;   // "hip_torque_N_m": of the file, and its column unless another one is named
  const char* name;  // "hip_torque", as in input.hip_torque.delay
  Range range;       // what a sample may be, with its unit
};
const InputInfo& InfoOf(InputKind kind);
std::vector<std::string> InputKeys();
std::optional<InputKind> InputFromKey(std::string_view key);

}  // namespace hoplab
