#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/input_kind.h"
#include "datasets/origin.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

/// A column that drives the simulation: scale u(t - delay), u the column.
struct InputSpec {
  InputKind id = InputKind::kHipTorque;
  std::string column;      // of the trace
  bool held = false;       // between rows: held from the row before; else linear
  bool of_stance = false;  // held, and none in flight (M123)
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

const InputSpec* FindInput(const std::vector<InputSpec>& inputs, InputKind id);

}  // namespace hoplab
