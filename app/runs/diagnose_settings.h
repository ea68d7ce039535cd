#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/runs/problem_settings.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// What the command line of `hoplab diagnose` says.
struct DiagnoseSettings : RunSettings {
  ProblemSettings problem{.solver = {.tolerance = kDiagnosisSteps.relative_tolerance}};
  std::vector<std::string> effects, without;
  int max_effects = DiagnosisOptions().max_effects;
  double material = 100.0 * kMaterial;  // [%]
  int restarts = 1;
  std::uint64_t seed = 1;
  std::string span = "whole_else_hops";
  std::string discrepancy = "matern";
  bool discover = false;
};

void AddDiagnoseOptions(CLI::App& sub, DiagnoseSettings& settings);

/// Throws UsageError for a `--fix` that is no name=value.
DiagnosisOptions DiagnosisOptionsOf(const DiagnoseSettings& settings);

}  // namespace hoplab
