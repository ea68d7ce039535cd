#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "app/runs/optimize_settings.h"
#include "app/terminal/progress.h"
#include "optimize/fixed_point.h"
#include "optimize/robustness.h"

namespace hoplab {

/// All that `hoplab optimize` computes.
struct OptimizeRun {
  SearchProblem problem;
  GainSearchOptions options;
  GainSearchResult result;
  std::vector<double> scenario_x;  // the scenario's own values of the variables
  SearchPoint before;              // the scenario as it stands
  Robustness before_robustness, best_robustness;
  FixedPoint before_gait, best_gait;  // steady hops, not found where there are none
  std::vector<MapCell> map;

  /// A point that converges within the constraints was found.
  bool has_result() const;
  /// Why there is no usable result; empty if there is one.
  std::string Failure() const;
};

/// The variables, the scenario's own values of them, and how to search. Throws InputError for a
/// scenario that cannot be searched.
OptimizeRun PrepareOptimize(const OptimizeSettings& settings, const std::vector<OverOption>& over,
                            const ScenarioDocument& document, const Scenario& scenario);

/// Searches, then tries out the best point: gaits, robustness, the objective's map. `stop` ends it
/// early.
void RunOptimize(const OptimizeSettings& settings, const std::atomic<bool>* stop,
                 Progress& progress, OptimizeRun& run);

}  // namespace hoplab
