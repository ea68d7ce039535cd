#pragma once

#include <string>
#include <vector>

#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "model/simulate.h"

namespace hoplab {

/// What the command line of `hoplab simulate` says.
struct SimulateSettings : RunSettings {
  ScenarioSettings scenario;
  SolverSettings solver;
  std::vector<std::string> sensitivities;
};

void AddSimulateOptions(CLI::App& sub, SimulateSettings& settings);

/// A scenario as it is simulated; the request points into the rest, and into the scenario.
struct ScenarioRequest {
  /// Throws InputError for a law, an effect or a direction that the scenario does not have.
  ScenarioRequest(const SimulateSettings& settings, const Scenario& scenario);
  ScenarioRequest(const ScenarioRequest&) = delete;
  ScenarioRequest& operator=(const ScenarioRequest&) = delete;

  std::vector<DrivenInput> inputs;
  std::vector<EffectSetting> effects;
  std::vector<SensitivityDirection> directions;
  SimulationRequest request;
};

}  // namespace hoplab
