#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.h"

namespace hoplab {

/// What one residual block spans.
enum class Segmentation {
  kAuto,  // whole traces, ends that cannot be simulated left out; where those are much, single hops
  kWhole,  // whole traces or nothing
  kHops    // single hops, each with a start of its own
};
std::string_view NameOf(Segmentation span);
std::optional<Segmentation> FindSpan(std::string_view name);

struct DatasetFit {
  FitProblem problem;  // the one that was fitted: trials are hops if `by_hop`
  FitResult result;
  bool by_hop = false;
  std::optional<double> until;  // s, where trials were fitted up to there only
  /// Train hops (or trials, or ends of trials) that no values found let be simulated; they are not
  /// in `problem`.
  std::vector<std::string> left_out;
  /// Why it was fitted hop by hop or in part, or that hops and whole traces disagree.
  std::string note;
  /// Of each channel: the mean square, over sigma squared, that noise alone leaves (NoiseSquares);
  /// empty: 1.
  std::vector<double> noise_squares;
};

/// Sets up and fits a dataset. A law that cannot carry a simulation through a whole trace (it falls
/// where the hopper did not, whatever the parameters) is fitted to the trials without their ends;
/// where that loses more than a quarter of the samples, it is still fitted to single hops, which is
/// said; hops (or trials without apexes) that it cannot carry either are left out and named. Of a
/// robot, whose trials have no such hops, as much of each trial is fitted as the law can follow.
/// What a fit's end is worth is `result.stop`. Throws InputError as MakeProblem does.
DatasetFit FitDataset(const Dataset& dataset, const ProblemOptions& problem_options,
                      const FitOptions& fit_options, Segmentation span = Segmentation::kAuto);

/// The same of a problem that is set up already.
DatasetFit FitTraces(FitProblem problem, const FitOptions& fit_options,
                     Segmentation span = Segmentation::kAuto);

}  // namespace hoplab
