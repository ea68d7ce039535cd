#pragma once

#include <set>
#include <vector>

#include "fitting/diagnosis/name.h"

namespace hoplab {

/// Says of every candidate what came of it beside `model`, the members `set` of
/// `naming.candidates`: sets `status`, and `bound95`, how large it can be, 95 %, where it is not a
/// member. `looked_at`: candidates with a threshold that were fitted beside others, not alone.
void SetStatuses(const FittedModel& model, const CandidateSet& set, const std::set<int>& looked_at,
                 const std::vector<TrialProblem>& train, int jobs, Naming& naming);

}  // namespace hoplab
