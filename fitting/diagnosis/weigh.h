#pragma once

#include "fitting/diagnosis/refits.h"

namespace hoplab {

/// What can take the place of each member of the best set: the fewest that hold 95 % of the weight
/// of that place. Fills groups, their weights, rivals and gaps.
void FindGroups(const CandidateSet& set, const Refits& refits, Naming& naming);

/// Probabilities of candidates and of something not listed, over all models visited.
void Weigh(const Refits& refits, Naming& naming);

}  // namespace hoplab
