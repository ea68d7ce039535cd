#pragma once

#include <span>
#include <vector>

#include "fitting/diagnosis/name.h"

namespace hoplab {

/// Adds to a search its candidates of one parameter in single trials, and in several with one size
/// for these; those that promise nearly as much there as in all trials, and no less than
/// `least_gain` [nats]. Several: from four trials on, where hardly anything more is promised by a
/// size of its own in each trial. At most twelve of each kind; whether one was added is returned.
/// `at` is the linearisation of a model, whose columns are the candidates at `places` of `naming`.
bool AddInSomeTrials(Naming& naming, const Linearisation& at, std::span<const int> places,
                     const std::vector<TrialProblem>& train, double least_gain);

}  // namespace hoplab
