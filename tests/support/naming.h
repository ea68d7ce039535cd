#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "fitting/diagnosis/name.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab::testing {

/// The causes named of a null fit, among `candidates`.
inline Naming NameIn(const NullFit& fit, const std::vector<Candidate>& candidates,
                     const NamingOptions& options = {}) {
  return NameCauses(fit.fits(), candidates, fit.Linearised(fit.settled, candidates), fit.train,
                    options);
}
/// The same among kSixEffects.
inline Naming NameSix(const NullFit& fit, const NamingOptions& options = {}) {
  return NameIn(fit, CandidatesOf(kSixEffects), options);
}

/// Names of the causes of the best model.
inline std::vector<std::string> MembersOf(const Naming& n) {
  std::vector<std::string> names;
  for (const Candidate& c : n.best.members) names.push_back(c.Name());
  return names;
}

/// What is told of a candidate.
inline const CandidateResult& ResultOf(const Naming& n, const std::string& name) {
  for (const CandidateResult& c : n.candidates) {
    if (c.candidate.Name() == name) return c;
  }
  throw std::logic_error("no candidate " + name);
}

}  // namespace hoplab::testing
