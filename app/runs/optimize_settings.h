#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "experiments/scenario_search.h"
#include "optimize/gain_search.h"

namespace hoplab {

/// What the command line of `hoplab optimize` says.
struct OptimizeSettings : RunSettings {
  ScenarioSettings scenario;
  std::vector<std::string> over;
  std::string algorithm{NameOf(GainSearchOptions().algorithm)};
  std::optional<int> budget;
  std::uint64_t seed = GainSearchOptions().seed;
  int seeds = GainSearchOptions().seeds;
  double weight = SearchProblem().weight;
  int map_size = 25;
  int jobs = 0;
  SolverSettings solver;
};

void AddOptimizeOptions(CLI::App& sub, OptimizeSettings& settings);

/// Throws UsageError for an --over that is neither a name nor name=low:high.
std::vector<OverOption> OverOptionsOf(const OptimizeSettings& settings);

GainSearchOptions SearchOptionsOf(const OptimizeSettings& settings, const Scenario& scenario);

}  // namespace hoplab
