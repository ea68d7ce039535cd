#pragma once

#include <vector>

#include "fitting/edges.h"
#include "fitting/solve.h"
#include "fitting/trial_evaluations.h"
#include "fitting/values_on_bounds.h"

namespace hoplab {

/// What a run of Ceres moves, and for how long.
struct RunSettings {
  std::vector<Edge> edges;  // that it stays on
  Places held;
  Places not_to_bound;  // values that were tried on their bound in vain
  int max_iterations = 0;
};

/// One run of Ceres, from where the evaluations are to where they are then.
struct CeresRun {
  SolveResult result;
  /// Free shared values beyond whose bounds a step led that was not taken.
  Places beyond;
};
CeresRun RunCeres(const SolveRequest& request, const RunSettings& settings,
                  TrialEvaluations& evaluations);

}  // namespace hoplab
