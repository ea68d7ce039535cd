#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "datasets/read_scenario.h"

namespace hoplab {

/// Options of every command that reads a scenario, that say what is simulated.
struct ScenarioSettings {
  std::string scenario;
  std::string law;
  std::vector<std::string> set;   // dotted.key=value
  std::vector<std::string> with;  // effect:parameter=value
};

void AddScenarioOptions(CLI::App& sub, ScenarioSettings& settings);

/// The file with the options put over it. Throws UsageError for options that are not of the form
/// above, InputError for a file that is no YAML or an effect that does not exist.
ScenarioDocument ScenarioDocumentOf(const ScenarioSettings& settings);

/// The same, read; throws InputError for a bad scenario, too.
Scenario ReadScenarioOf(const ScenarioSettings& settings);

}  // namespace hoplab
