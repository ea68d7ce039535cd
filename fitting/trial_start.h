#pragma once

#include "datasets/dataset.h"
#include "fitting/problem.h"

namespace hoplab {

/// Priors tighter than this pin a component: the optimiser still sees a well-scaled variable.
inline constexpr double kTightestPrior = 1e-9;

/// Gives `t` its start and its own values: as the trial states them, else from the first flight of
/// its trace. Throws InputError where neither tells.
void SetStart(const Trial& trial, const FitProblem& problem, TrialProblem& t);

}  // namespace hoplab
