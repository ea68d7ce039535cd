#pragma once

#include "datasets/dataset.h"
#include "fitting/problem.h"

namespace hoplab {

/// Gives `t` its start and its own values: as the trial states them, else from the first flight of
/// its trace. Throws InputError where neither tells.
void SetStart(const Trial& trial, const FitProblem& problem, TrialProblem& t);

}  // namespace hoplab
