#pragma once

#include <cstdint>

#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "experiments/sweep.h"

namespace hoplab {

/// What the command line of `hoplab sweep` says.
struct SweepSettings : RunSettings {
  ScenarioSettings scenario;
  std::uint64_t seed = 1;
  int jobs = 0;
  SolverSettings solver;
};

void AddSweepOptions(CLI::App& sub, SweepSettings& settings);

SweepPlan SweepPlanOf(const SweepSettings& settings);

}  // namespace hoplab
