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

/// What to reproduce, but for the study. Throws InputError for an item or a length that cannot be.
ReproductionRequest ReproductionRequestOf(const ReproduceSettings& settings);

}  // namespace hoplab
