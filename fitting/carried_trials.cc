#include "fitting/carried_trials.h"

#include <utility>

#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

// Leaves out the train trials that a fit's values do not let be simulated.
void LeaveOut(const FitResult& fit, FitProblem& problem, std::vector<std::string>& left_out) {
  std::vector<TrialProblem> kept;
  std::size_t train = 0;
  for (TrialProblem& trial : problem.trials) {
    bool carried = true;
    if (trial.role == TrialRole::kTrain) {
      TrialEvaluation e;
      TrialEvaluator(problem, trial).Evaluate({fit.shared, fit.initial_states[train++]}, e);
      carried = e.complete;
    }
    if (carried)
      kept.push_back(std::move(trial));
    else
      left_out.push_back(trial.file);
  }
  problem.trials = std::move(kept);
}

}  // namespace

FitResult FitCarriedTrials(FitProblem& problem, const FitOptions& options, int rounds,
                           std::vector<std::string>& left_out) {
  for (int round = 1;; ++round) {
    FitResult fit = Fit(problem, options);
    if (!fit.ok || fit.stop.complete || fit.interrupted || round >= rounds) return fit;
    LeaveOut(fit, problem, left_out);
    if (!TrialsOf(problem, TrialRole::kTrain).empty()) continue;
    fit.ok = false;
    return fit;
  }
}

}  // namespace hoplab
