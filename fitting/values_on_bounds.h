#pragma once

#include <vector>

#include "fitting/solve.h"
#include "fitting/trial_evaluations.h"

namespace hoplab {

/// Places of shared values in FitProblem::shared.
using Places = std::vector<int>;
bool Contains(const Places& places, int k);

/// Whether a shared value lies on its bound, but for rounding.
bool IsOnLower(const SharedParameter& s, double value);
bool IsOnUpper(const SharedParameter& s, double value);

/// The shared values on a bound that the cost pushes outward, at the last point whose derivatives
/// were asked for; those that the request holds are left out.
Places PushedOut(const SolveRequest& request, const TrialEvaluations& evaluations);

}  // namespace hoplab
