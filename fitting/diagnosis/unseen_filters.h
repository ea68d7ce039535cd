#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fitting/diagnosis/linearisation.h"
#include "fitting/diagnosis/name.h"

namespace hoplab {

/// What a search with filters of which the noise does not tell begins with.
struct FilterRequest {
  NullFits null;
  std::span<const Candidate> candidates;  // of the search without them
  std::span<const Candidate> filters;     // UnseenFilters
  const Naming* without = nullptr;        // what that search found
  const std::vector<TrialProblem>* train = nullptr;
  NamingOptions naming;
  /// The linearisation at the null fit with columns of such candidates.
  std::function<Linearisation(std::span<const Candidate>)> null_at;
};

/// Searches anew, with them behind the other candidates, where one of them is worth more among the
/// causes that were found and those that explain most alone. Absent where none is in the end. It is
/// for the caller to ask what that leaves: a filter that lags is like a leg that pushes.
std::optional<Naming> NameWithFilters(const FilterRequest& request);

}  // namespace hoplab
