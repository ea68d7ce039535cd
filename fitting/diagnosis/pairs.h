#pragma once

#include <span>
#include <vector>

#include "fitting/diagnosis/linearisation.h"
#include "fitting/diagnosis/name.h"

namespace hoplab {

/// The pairs of candidates with one parameter each, acting in all trials, that promise most nats by
/// the linear model at the null fit: at most six, each at least `least` nats.
std::vector<CandidateSet> PairsFromNull(std::span<const CandidateResult> candidates,
                                        const Linearisation& null_at, double least);

}  // namespace hoplab
