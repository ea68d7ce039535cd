#include "fitting/followed_part.h"

#include <utility>

#include "fitting/trial_evaluator.h"

namespace hoplab {

std::optional<FollowedPart> FitFollowedPart(const FitProblem& problem, const FitOptions& options) {
  std::optional<FollowedPart> longest;
  for (const double share : {0.2, 0.3, 0.45, 0.65, 0.85}) {
    FollowedPart part;
    part.share = share;
    part.problem = problem;
    for (TrialProblem& trial : part.problem.trials) trial = FirstPart(problem, trial, share);
    part.result = Fit(part.problem, options);
    if (part.result.interrupted) break;
    if (!part.result.ok || !part.result.stop.IsMinimum()) break;
    longest = std::move(part);
  }
  return longest;
}

}  // namespace hoplab
