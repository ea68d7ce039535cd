#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fitting/diagnosis/name.h"

namespace hoplab {

/// Begins a search: the given candidates with their scores at the null fit, then those of single
/// trials that promise nearly as much as in all, and what a parameter of each must gain.
void FillPool(Naming& naming, std::span<const Candidate> candidates, const Linearisation& null_at,
              const std::vector<TrialProblem>& train, const NamingOptions& options);

/// The candidates of the best scores under the null fit's own noise, each alone.
std::vector<CandidateSet> BestScored(const Naming& naming);

/// Places, among the first `count` candidates, of those whose effect does not act in the set.
std::vector<int> PlacesBeside(const Naming& naming, const CandidateSet& set, int count);

std::vector<Candidate> CandidatesAt(const Naming& naming, std::span<const int> places);

/// The candidate without which candidate i hardly shows (EffectInfo::shows_beside).
std::optional<int> ShowsBeside(const Naming& naming, int i);

}  // namespace hoplab
