#pragma once

#include <cstdint>
#include <string>

#include "app/runs/run_settings.h"
#include "experiments/identification/identification.h"

namespace hoplab {

/// What the command line of `hoplab identify` says.
struct IdentifySettings : RunSettings {
  std::string tables = "all", times = "all";
  int budget = IdentificationRequest().budget;
  int readings = IdentificationRequest().keep_readings;
  int keep = IdentificationRequest().keep;
  int keep_toe = IdentificationRequest().keep_toe;
  int toe_budget = IdentificationRequest().toe_budget;
  std::uint64_t seed = IdentificationRequest().seed;
  bool free_damping_scale = false, free_rolling_blend = false, free_toe_mass = false;
  bool free_desired_speed = false, placed_as_printed = false;
  int jobs = 0;
  SolverSettings solver{.tolerance = 1e-7};
};

void AddIdentifyOptions(CLI::App& sub, IdentifySettings& settings);

/// Throws InputError for tables or readings that the study does not have.
IdentificationRequest IdentificationRequestOf(const IdentifySettings& settings);

/// "`hoplab identify --budget 600 --seed 1`, 2026-01-31": what a scenario says of its origin.
std::string OriginText(const IdentifySettings& settings);

}  // namespace hoplab
