#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fitting/diagnosis/candidate.h"
#include "fitting/diagnosis/linearisation.h"

namespace hoplab {

/// A cause that is there in every trial, of another size in each, about none in the mean: angles
/// that were set by hand. Neither one size for all nor one in a single trial shows it.
struct OwnSizes {
  Candidate cause;
  std::vector<double> sizes;  // to first order, one a train trial, in the parameter's unit
  double explained = 0.0;     // share of the misfit beyond noise that they take up, 0..1
  std::string beside;         // a cause that acts in all trials, of one size, and explains its part
};

/// The cause of one parameter that explains most so, by sizes that it can have. `at`: the
/// candidates beside a model. Absent where none explains kLeastOwn of the misfit
/// and gains what further sizes cost.
inline constexpr double kLeastOwn = 0.7;
std::optional<OwnSizes> BestOwnSizes(const Linearisation& at, std::span<const Candidate> candidates,
                                     const std::vector<TrialProblem>& train);

/// A sentence about them.
std::string TextOf(const OwnSizes& own, const std::vector<TrialProblem>& train);

}  // namespace hoplab
