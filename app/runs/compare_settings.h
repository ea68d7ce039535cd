#pragma once

#include <string>
#include <vector>

#include "app/runs/problem_settings.h"
#include "experiments/law_comparison.h"

namespace hoplab {

/// What the command line of `hoplab compare` says.
struct CompareSettings {
  ProblemSettings problem;
  std::vector<std::string> models;  // "law+effect+effect"
  std::vector<std::string> truth;   // "name=value"
  bool json = false, quiet = false;
};

void AddCompareOptions(CLI::App& sub, CompareSettings& settings);

/// The models to fit: those asked for, or every law of the mechanism.
std::vector<ComparedModel> ComparedModels(const CompareSettings& settings, const Dataset& dataset);

}  // namespace hoplab
