#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/runs/fit_run.h"
#include "app/runs/problem_settings.h"

namespace hoplab {

/// What the command line of `hoplab fit` says.
struct FitSettings : RunSettings {
  ProblemSettings problem;
  int restarts = 1;
  std::uint64_t seed = 1;
  std::string strategy = "apex_shooting";
  std::string span = "whole_else_hops";
  std::string loss = "squared";
  std::string discrepancy = "matern";
  double loss_scale = Loss().scale;
  std::vector<std::string> profile;
};

void AddFitOptions(CLI::App& sub, FitSettings& settings);

/// Throws UsageError for a `--fix` that is no name=value.
FitRunOptions FitRunOptionsOf(const FitSettings& settings);

}  // namespace hoplab
