#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "datasets/dataset.h"
#include "datasets/scenario.h"
#include "model/simulate.h"

namespace hoplab {

/// How a dataset is made of a scenario.
struct GenerateOptions {
  std::optional<double> noise;  // standard deviation of every channel, its own unit; else the
                                // scenario's sigmas
  std::uint64_t seed = 1;
  /// Another method and tolerance than fits use, so that no test compares the simulator with
  /// itself.
  IntegratorOptions integrator = {IntegratorKind::kErkStep, 1e-12, 1e-13};
};

struct GeneratedDataset {
  Dataset dataset;
  /// Per trial, where a run ended before its horizon: "train-1.csv: fell ... at 0.41 s; 205 of 500
  /// rows written".
  std::vector<std::string> notes;
};

/// Simulates the scenario's trials with its effects and adds noise. True initial states are drawn
/// about nothing: the scenario's `initial` is the truth, and what the dataset states as nominal
/// start is off by a draw from `initial_sigma` where that is given. The dataset says neither
/// effects nor their size. Throws InputError if a run has no rows at all or the scenario lacks what
/// it needs.
GeneratedDataset GenerateDataset(const Scenario& scenario, const GenerateOptions& options);

/// What drives a scenario's run, for its request to point into.
std::vector<DrivenInput> DrivenInputsOf(const Scenario& scenario);

InputSet KindsOf(const std::vector<DrivenInput>& inputs);
/// Throws InputError where a run touches down more often than it has angles of its own. `file` may
/// be empty.
void CheckAngleEach(const std::vector<double>& angles, const Trajectory& run,
                    const std::string& place, const std::string& file = "");

/// The scenario's run as a simulation request; spans in it point into `effects`. Throws InputError
/// for a scenario that a log drives, or whose touch-downs have angles of their own.
SimulationRequest RequestOfScenario(const Scenario& scenario,
                                    const std::vector<EffectSetting>& effects);
/// The same for any scenario; spans point into `scenario` and `inputs` (DrivenInputsOf) too.
SimulationRequest RequestOfScenario(const Scenario& scenario,
                                    const std::vector<EffectSetting>& effects,
                                    const std::vector<DrivenInput>& inputs);

}  // namespace hoplab
