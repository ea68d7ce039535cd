#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// Options of `fit`, `diagnose` and `check` that say what of a dataset is fitted.
struct ProblemSettings {
  std::string dataset;
  std::string law;
  std::vector<std::string> free, fix, with;
  std::string integrator = "dop853";
  double tolerance = 1e-9;
  int jobs = 0;  // 0: all cores
};

void AddProblemOptions(CLI::App& sub, ProblemSettings& settings);
void AddIntegratorOptions(CLI::App& sub, std::string& integrator, double& tolerance);

/// `name=value` texts of an option; throws UsageError for what is none, or given twice.
std::map<std::string, double> ParseAssignments(const std::vector<std::string>& texts,
                                               const std::string& option);

/// Throws UsageError for a `--fix` that is no name=value.
ProblemOptions ProblemOptionsOf(const ProblemSettings& settings);
IntegratorOptions IntegratorOptionsOf(const std::string& integrator, double tolerance);
int JobsOf(int jobs);

}  // namespace hoplab
