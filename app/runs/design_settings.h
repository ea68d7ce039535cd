#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/runs/design_run.h"
#include "app/runs/problem_settings.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// What the command line of `hoplab design` says.
struct DesignSettings : RunSettings {
  ProblemSettings problem{.solver = {.tolerance = kDiagnosisSteps.relative_tolerance}};
  std::vector<std::string> cause, space;
  std::string sharpen;
  int budget = DesignRunOptions().budget;
  int map_size = DesignRunOptions().map_size;
  std::uint64_t seed = 1;
  std::string discrepancy = "matern";
};

void AddDesignOptions(CLI::App& sub, DesignSettings& settings);

/// Throws UsageError for a --space that is no range, InputError for a setting that is none.
DesignRunOptions DesignRunOptionsOf(const DesignSettings& settings);

}  // namespace hoplab
