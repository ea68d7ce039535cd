#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/search_objective.h"
#include "datasets/dataset.h"
#include "datasets/effect_file.h"
#include "datasets/mechanism_spec.h"

namespace hoplab {

// What `simulate`, `generate`, `gait`, `optimize` and `sweep` read (format `hoplab-scenario/1`).
// Each named thing that a later layer has to check (laws, effects, outputs, ...) keeps its place
// for the message.

/// A number under a dotted key of the scenario, as `controller.kp_N_s`, or a parameter by its name.
struct NamedNumber {
  std::string name;
  double value = 0;
  Origin origin = {};
  bool operator==(const NamedNumber&) const = default;
};

/// An effect and its parameters in the order of the file.
struct EffectSpec {
  std::string name;
  std::vector<NamedNumber> parameters;
  Origin origin = {};
  std::optional<EffectFile> formula = {};  // of an effect that is one
  bool at_typical = false;                 // no parameters are given: each at its typical size
  bool operator==(const EffectSpec&) const = default;
};

/// When a run ends, whichever comes first; absent: no such end.
struct StopSpec {
  std::optional<double> time_s;
  std::optional<int> hops;
  bool operator==(const StopSpec&) const = default;
};

/// A dotted key and the closed interval it is varied in, low < high.
struct KeyRange {
  std::string key;
  double low = 0;
  double high = 0;
  Origin origin = {};
  bool operator==(const KeyRange&) const = default;
};

struct SearchSpec {
  std::vector<KeyRange> over;
  SearchObjective objective = SearchObjective::kConvergenceTime;
  std::vector<NamedNumber> constraints;  // names as in the file, unit included
  std::optional<int> budget;             // evaluations
  Origin origin = {};
  bool operator==(const SearchSpec&) const = default;
};

enum class SweepKind { kGrid, kList, kLatinHypercube };

/// A dotted key and the values it takes.
struct SweepAxis {
  std::string key;
  std::vector<double> values;
  Origin origin = {};
  bool operator==(const SweepAxis&) const = default;
};

/// A column of the result, not checked here.
struct OutputName {
  std::string name;
  Origin origin = {};
  bool operator==(const OutputName&) const = default;
};

/// Of `grid`, `list` and `ranges` with `samples` only what `kind` names is filled.
struct SweepSpec {
  SweepKind kind = SweepKind::kGrid;
  std::vector<SweepAxis> grid;                 // all combinations
  std::vector<std::vector<NamedNumber>> list;  // one row after the other, all with the same keys
  std::vector<KeyRange> ranges;                // Latin hypercube
  int samples = 0;
  std::vector<OutputName> outputs;
  Origin origin = {};
  bool operator==(const SweepSpec&) const = default;
};

/// A logged column that drives a scenario's runs, out of a CSV file beside it.
struct ScenarioInput {
  InputSpec spec;
  std::vector<double> time_s, values;  // without missing samples
  double sigma = 0;                    // noise that `generate` adds to what it writes of it
  bool operator==(const ScenarioInput&) const = default;
};

/// One trial to generate, resolved: the scenario's values with the trial's own over them.
struct GenerateTrial {
  std::string file;  // "train-1.csv"
  TrialRole role = TrialRole::kTrain;
  double touchdown_angle_rad = 0;
  std::vector<double> touchdown_angles_rad;  // one a touch-down; empty: the one above for all
  std::optional<StateSpec> initial;
  std::optional<ControllerSpec> controller;
  MechanismSpec mechanism;
  bool operator==(const GenerateTrial&) const = default;
};

/// What `generate` makes of a scenario: several trials, the columns to write and their noise.
struct GenerateSpec {
  std::optional<std::string> name;
  std::optional<std::string> title;
  std::optional<double> sample_rate_hz;
  std::vector<ChannelSpec> channels;  // sigma given for each; empty if the block is absent
  std::optional<StateSpec> initial_sigma;
  std::optional<double> touchdown_angle_sigma_rad;  // by which the stated angles are off
  std::vector<GenerateTrial> trials;                // at least one
  bool operator==(const GenerateSpec&) const = default;
};

struct Scenario {
  std::string name;
  std::optional<std::string> law;  // not checked here
  Origin law_origin = {};
  MechanismSpec mechanism;
  std::optional<ControllerSpec> controller;  // absent: no torque in stance
  double touchdown_angle_rad = 0;            // 0 for a ball, which has none
  std::vector<double> touchdown_angles_rad;  // one a touch-down; empty: the one above for all
  std::vector<ScenarioInput> inputs;
  std::optional<double> start_angle_rad;  // of the first touch-down, if another one (M47)
  std::optional<StateSpec> initial;
  StopSpec stop;
  std::vector<EffectSpec> effects;  // names and parameters not checked here
  std::optional<SearchSpec> search;
  std::optional<SweepSpec> sweep;
  std::optional<GenerateSpec> dataset;
  Origin origin = {};  // of the file
  bool operator==(const Scenario&) const = default;
};

/// The scenario's initial state; throws InputError if it has none.
const StateSpec& RequireInitial(const Scenario& scenario);

}  // namespace hoplab
