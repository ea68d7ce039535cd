#pragma once

#include <string>
#include <vector>

#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "experiments/study/reproduction.h"

namespace hoplab {

inline constexpr const char* kConstants = "experiments/published.yaml";

/// What the command line of `hoplab reproduce` says.
struct ReproduceSettings : RunSettings {
  std::vector<std::string> items;
  ScenarioSettings constants{.scenario = kConstants};
  TwoLegs legs;
  int jobs = 0;
  SolverSettings solver;
};

void AddReproduceOptions(CLI::App& sub, ReproduceSettings& settings);

/// The constants with the options put over them. Those that come along are looked for in the
/// project's folder and where they were installed. Throws as ScenarioDocumentOf, and InputError
/// where they are in neither.
ScenarioDocument ConstantsOf(const ReproduceSettings& settings);

/// What to reproduce, but for the study. Throws InputError for an item or a length that cannot be.
ReproductionRequest ReproductionRequestOf(const ReproduceSettings& settings);

}  // namespace hoplab
