#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "app/runs/run_settings.h"
#include "fitting/problem.h"

namespace hoplab {

/// Options of `fit`, `diagnose` and `check` that say what of a dataset is fitted.
struct ProblemSettings {
  std::string dataset;
  std::string law;
  std::vector<std::string> free, fix, with;
  bool keep_stray = false;
  SolverSettings solver;
  int jobs = 0;  // 0: all cores
};

void AddProblemOptions(CLI::App& sub, ProblemSettings& settings);

/// `--discrepancy matern|none`: what the noise is taken for.
void AddDiscrepancyOption(CLI::App& sub, std::string& discrepancy);

/// `name=value` texts of an option; throws UsageError for what is none, or given twice.
std::map<std::string, double> ParseAssignments(const std::vector<std::string>& texts,
                                               const std::string& option);

/// Throws UsageError for a `--fix` that is no name=value.
ProblemOptions ProblemOptionsOf(const ProblemSettings& settings);

}  // namespace hoplab
