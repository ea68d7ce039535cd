#pragma once

#include <vector>

#include "fitting/shared_bounds.h"
#include "fitting/solve.h"
#include "fitting/trial_evaluations.h"

namespace hoplab {

/// Places of shared values in FitProblem::shared.
using Places = std::vector<int>;
bool Contains(const Places& places, int k);

/// The shared values on a bound that the cost pushes outward, at the last point whose derivatives
/// were asked for; those that the request holds are left out.
Places PushedOut(const SolveRequest& request, const TrialEvaluations& evaluations);

}  // namespace hoplab
