#pragma once

#include <span>
#include <vector>

#include "fitting/diagnosis/name.h"

namespace hoplab {

/// Adds to a search its candidates in single trials, those that promise nearly as much there as in
/// all trials, and no less than `least_gain` [nats]; at most twelve, whether one was added is
/// returned. `at` is the linearisation of a model, whose columns are the candidates at `places` of
/// `naming`.
bool AddInOneTrial(Naming& naming, const Linearisation& at, std::span<const int> places,
                   const std::vector<TrialProblem>& train, double least_gain);

}  // namespace hoplab
