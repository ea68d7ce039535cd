#pragma once

#include <cstdint>
#include <string>

#include "app/runs/problem_settings.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// What the command line of `hoplab discover` says.
struct DiscoverSettings : RunSettings {
  ProblemSettings problem{.solver = {.tolerance = kDiagnosisSteps.relative_tolerance}};
  std::uint64_t seed = 1;
  std::string span = "whole_else_hops";
  std::string discrepancy = "matern";
  bool code = false;
};

void AddDiscoverOptions(CLI::App& sub, DiscoverSettings& settings);

DiagnosisOptions DiscoveryOptionsOf(const DiscoverSettings& settings);

}  // namespace hoplab
