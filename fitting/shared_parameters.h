#pragma once

#include "datasets/dataset.h"
#include "fitting/problem.h"

namespace hoplab {

/// Holds what --fix names and makes shared values of what --free and --with name, or of the
/// mechanism's default. Throws InputError (place: the option) as MakeProblem does.
void AddSharedParameters(const Dataset& dataset, const ProblemOptions& options,
                         FitProblem& problem);

}  // namespace hoplab
