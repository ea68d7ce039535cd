#pragma once

#include <string>
#include <vector>

#include "app/records/run_record.h"
#include "optimize/fixed_point.h"
#include "optimize/gain_search.h"
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

/// Keys of a search in run.json.
void AddOptimize(const OptimizeRun& run, Json& record);
/// The objective map, and the history of all seeds, as CSV.
std::string MapTable(const OptimizeRun& run);
std::string HistoryTable(const OptimizeRun& run);
/// The steady hops before and best, from apex to apex, as CSV.
std::string CyclesTable(const OptimizeRun& run);
/// What the command prints.
std::string OptimizeReport(const std::string& name, const OptimizeRun& run, bool colours);

}  // namespace hoplab
