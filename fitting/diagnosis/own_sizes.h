#pragma once

#include <span>
#include <string>
#include <vector>

#include "fitting/diagnosis/diagnosis.h"
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

/// The causes of one parameter that explain most so, by sizes that they can have; of those that
/// explain as much as the best the one of the more usual sizes first. `at`: the candidates beside a
/// model. Empty where none explains kLeastOwn of the misfit, and a tenth of it more than one size
/// of the cause, and gains what further sizes cost.
inline constexpr double kLeastOwn = 0.7;
std::vector<OwnSizes> BestOwnSizes(const Linearisation& at, std::span<const Candidate> candidates,
                                   const std::vector<TrialProblem>& train);

/// The same, each cause once: beside the plain model of `diagnosis`, and beside the cause alone
/// that explains most in all trials of those it has found. `explained` is of the plain model's
/// misfit.
std::vector<OwnSizes> PromisingOwnSizes(const Diagnosis& diagnosis,
                                        std::span<const Candidate> candidates,
                                        const std::vector<TrialProblem>& train, int jobs);

/// A sentence about them.
std::string TextOf(const OwnSizes& own, const std::vector<TrialProblem>& train);

}  // namespace hoplab
