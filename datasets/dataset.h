#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/channel.h"
#include "datasets/effect_file.h"
#include "datasets/input_spec.h"
#include "datasets/known_spec.h"
#include "datasets/mechanism_spec.h"
#include "datasets/origin.h"
#include "datasets/trace.h"

namespace hoplab {

enum class SourceKind { kUnstated, kRecorded, kSimulated };

/// Where a dataset comes from; texts may be empty.
struct SourceSpec {
  SourceKind kind = SourceKind::kUnstated;
  std::string by;
  std::string licence;
  std::string note;
  bool operator==(const SourceSpec&) const = default;
};

/// A column that is a measurement, and its noise.
struct ChannelSpec {
  Channel id = Channel::kBodyX;
  std::optional<double>
      sigma;  // 1 standard deviation in the channel's unit; absent: to be estimated
  Origin origin = {};
  std::string clock = {};  // of the dataset's clocks; empty: the trial's own time
  bool operator==(const ChannelSpec&) const = default;
};

enum class TrialRole { kTrain, kTest };

/// The width of a prior that says nothing; its weight 1/sigma is zero.
inline constexpr double kFreeSigma = std::numeric_limits<double>::infinity();

/// One recorded run. Mechanism and controller are resolved: the dataset's, with the trial's own
/// values put over them..
struct Trial {
  std::string file;  // relative to the dataset's folder, with `/`
  TrialRole role = TrialRole::kTrain;
  double touchdown_angle_rad = 0;  // 0 for a ball, which has none; of several the first
  /// One for each touch-down of the record, in their order; empty: touchdown_angle_rad is that of
  /// all.
  std::vector<double> touchdown_angles_rad;
  bool touchdown_from_leg_angle = false;  // they were read from the column leg_angle_rad
  /// How well each is known; absent: as they say.
  std::optional<double> touchdown_angle_sigma_rad;
  std::optional<StateSpec> initial;  // nominal state at the first row
  /// Standard deviations of `initial`, kFreeSigma where the file gives none for a component;
  /// absent: all free.
  std::optional<StateSpec> initial_sigma;
  MechanismSpec mechanism;
  std::optional<ControllerSpec> controller;  // absent: no torque in stance
  std::vector<InputSpec> inputs;             // columns that drive the simulation
  Trace trace;
  Origin origin = {};
  bool operator==(const Trial&) const = default;
};

/// A folder of recorded hops, checked: at least one train trial, each channel with a sample in some
/// trial, all numbers finite and in their ranges.
struct Dataset {
  std::string name;
  std::string title;
  SourceSpec source;
  MechanismSpec mechanism;  // nominal values, the start of a fit
  std::optional<ControllerSpec> controller;
  std::vector<ChannelSpec> channels;
  std::vector<ClockSpec> clocks;
  std::vector<InputSpec> inputs;
  std::vector<KnownSpec> known;     // of causes, by effect or by its parameters
  std::vector<EffectFile> effects;  // formulas of its own, known by their names
  std::vector<Trial> trials;
  Origin origin = {};  // of dataset.yaml
  bool operator==(const Dataset&) const = default;
};

/// "train", "test".
const char* RoleName(TrialRole role);

}  // namespace hoplab
