#pragma once

#include <string>
#include <vector>

#include "datasets/read_scenario.h"
#include "optimize/gain_search.h"

namespace hoplab {

/// A variable of a search as the command line names it: a dotted key of the scenario, or a
/// parameter (`theta_td`, `kp`, `v_des`, `E`, `d`, `k`) for the key it stands for; with a range in
/// the key's unit, or without one where the scenario's search block has it.
struct OverOption {
  std::string name;
  std::optional<double> low, high;
};

/// The scenario's search block as a problem, its variables replaced by `over` unless that is empty.
/// The problem keeps a copy of `document`. Throws InputError for a scenario without a search block,
/// a constraint that does not exist, a variable without a range.
SearchProblem SearchProblemOfScenario(const ScenarioDocument& document, const Scenario& scenario,
                                      const std::vector<OverOption>& over,
                                      const IntegratorOptions& integrator);

}  // namespace hoplab
