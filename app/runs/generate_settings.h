#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"

namespace hoplab {

/// What the command line of `hoplab generate` says.
struct GenerateSettings {
  ScenarioSettings scenario;
  std::optional<double> noise;
  std::uint64_t seed = 1;
  std::string out;
  bool force = false, json = false;
};

void AddGenerateOptions(CLI::App& sub, GenerateSettings& settings);

}  // namespace hoplab
