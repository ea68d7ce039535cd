#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.h"

namespace hoplab {

/// A trial without what comes after the middle of its last flight before the simulation `run` of it
/// ends too early; absent where there is no flight before. A recording may go on after a hopper has
/// fallen, and a model that is a little wrong may fall where the hopper hopped on.
std::optional<TrialProblem> CarriedBeginning(const FitProblem& problem, const TrialProblem& trial,
                                             const Trajectory& run);

/// Whole trials, but for ends that no values found let be simulated.
struct BeginningsFit {
  FitProblem problem;                 // the one whose trials are cut
  FitResult result;                   // a minimum
  std::vector<std::string> left_out;  // "train-3.csv from 0.951 s on"
};

/// `result` is a fit of the whole trials of `problem`, incomplete. Trials are cut where the
/// simulation leaves them and all is fitted again, a few times; test trials are cut alike. Absent
/// where that leads to no minimum or costs more than a quarter of the train samples.
std::optional<BeginningsFit> FitBeginnings(const FitProblem& problem, const FitResult& result,
                                           const FitOptions& options);

}  // namespace hoplab
