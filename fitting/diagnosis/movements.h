#pragma once

#include <vector>

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// How the values of the model without causes moved when those of `best` joined, over what
/// `uncertainty` says of them.
std::vector<Movement> MovementsOf(const FittedModel& null, const Uncertainty& uncertainty,
                                  const FittedModel& best);

}  // namespace hoplab
