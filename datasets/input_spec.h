#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/range.h"
#include "datasets/origin.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

/// What a logged column can drive in a simulation: the hip torque in place of the controller's, the
/// leg angle commanded in flight, a force on the body in the world's axes.
enum class InputId { kHipTorque, kLegAngle, kBodyForceX, kBodyForceY };
inline constexpr std::array<InputId, 4> kAllInputs = {InputId::kHipTorque, InputId::kLegAngle,
                                                      InputId::kBodyForceX, InputId::kBodyForceY};

/// "hip_torque_N_m": the key of the file, and its column unless another one is named.
const char* InputName(InputId id);
/// What a sample may be, with its unit.
Range InputRange(InputId id);
std::vector<std::string> InputNames();
std::optional<InputId> InputFromName(std::string_view name);

/// A column that drives the simulation: scale u(t - delay), u the column.
struct InputSpec {
  InputId id = InputId::kHipTorque;
  std::string column;  // of the trace
  bool held = false;   // between rows: held from the row before; else linear
  double delay_s = 0;
  std::optional<double> delay_sigma_s;  // how well it is known; absent: it is as it says
  double scale = 1;
  std::optional<double> scale_sigma;  // likewise
  std::string clock;                  // empty: the trial's own time
  Origin origin = {};
  bool operator==(const InputSpec&) const = default;
};

/// Sensors that share a clock: what it stamps t was read at t + offset of the trial's time.
struct ClockSpec {
  std::string name;
  double offset_s = 0;
  std::optional<double> sigma_s;  // how well it is known; absent: it is as it says
  bool per_trial = false;         // another offset in each trial; else one for all
  Origin origin = {};
  bool operator==(const ClockSpec&) const = default;
};

/// The block `inputs`: {hip_torque_N_m: {hold: previous, delay_s: 0.002}}.
std::vector<InputSpec> ReadInputs(const YamlCursor& cursor);
/// The block `clocks`: {motor: {offset_s: 0, sigma_s: 0.002, per: trial}}.
std::vector<ClockSpec> ReadClocks(const YamlCursor& cursor);

const InputSpec* FindInput(const std::vector<InputSpec>& inputs, InputId id);

}  // namespace hoplab
