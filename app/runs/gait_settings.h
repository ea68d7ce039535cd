#pragma once

#include <string>

#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"

namespace hoplab {

/// What the command line of `hoplab gait` says.
struct GaitSettings : RunSettings {
  ScenarioSettings scenario;
  std::string along;
  int jobs = 0;
  SolverSettings solver{.tolerance = 1e-12};
};

void AddGaitOptions(CLI::App& sub, GaitSettings& settings);

}  // namespace hoplab
