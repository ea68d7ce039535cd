#include "fitting/diagnosis/unseen_filters.h"

#include <algorithm>
#include <utility>

namespace hoplab {
namespace {

constexpr int kMostAtFirst = 3;

bool HasFilter(const Naming& naming) {
  return std::any_of(
      naming.best.members.begin(), naming.best.members.end(),
      [](const Candidate& c) { return c.effect->info.filter != RecordFilter::kNone; });
}

bool PaysMore(const Naming& naming, const Naming& without) {
  return !naming.interrupted && HasFilter(naming) && naming.worth > without.worth;
}

Naming SearchAmong(std::vector<Candidate> candidates, const FilterRequest& request,
                   const NamingOptions& options) {
  candidates.insert(candidates.end(), request.filters.begin(), request.filters.end());
  return NameCauses(request.null, candidates, request.null_at(candidates), *request.train, options);
}

// What was found, and what explains most alone: that may have been there, and been left for what
// stood in for it and the filter.
std::vector<Candidate> Leaders(const Naming& without) {
  constexpr std::size_t kAlone = 4;
  std::vector<Candidate> leaders = without.best.members;
  std::vector<const CandidateResult*> alone;
  for (const CandidateResult& c : without.candidates)
    if (c.gain > 0.0) alone.push_back(&c);
  std::stable_sort(
      alone.begin(), alone.end(),
      [](const CandidateResult* a, const CandidateResult* b) { return a->gain > b->gain; });
  if (alone.size() > kAlone) alone.resize(kAlone);
  for (const CandidateResult* c : alone)
    if (std::find(leaders.begin(), leaders.end(), c->candidate) == leaders.end())
      leaders.push_back(c->candidate);
  std::erase_if(leaders, [](const Candidate& c) { return !c.in_all(); });
  return leaders;
}

}  // namespace

std::optional<Naming> NameWithFilters(const FilterRequest& request) {
  // First among few, which is soon over.
  NamingOptions first = request.naming;
  first.begin = {};
  first.max_effects = std::min(first.max_effects, kMostAtFirst);
  first.in_some_trials = false;
  first.picked_from = static_cast<int>(request.candidates.size() + request.filters.size());
  if (!PaysMore(SearchAmong(Leaders(*request.without), request, first), *request.without))
    return std::nullopt;
  Naming naming =
      SearchAmong({request.candidates.begin(), request.candidates.end()}, request, request.naming);
  if (!PaysMore(naming, *request.without)) return std::nullopt;
  return naming;
}

}  // namespace hoplab
