#pragma once

#include <string>
#include <vector>

#include "fitting/fit.h"

namespace hoplab {

/// Fits the trials of a problem (whole traces or hops), at most `rounds` times. Train trials that
/// no values found let be simulated are left out of the problem and named, and the rest is fitted
/// again. The result is of the trials that the problem then has; it is not complete where the last
/// round, too, has some that cannot be simulated.
FitResult FitCarriedTrials(FitProblem& problem, const FitOptions& options, int rounds,
                           std::vector<std::string>& left_out);

/// Gives the priors on shared values of trials that are left out to the first train trial of those
/// that stay.
void KeepPriors(const std::vector<SharedPrior>& of_left_out, std::vector<TrialProblem>& trials);

}  // namespace hoplab
