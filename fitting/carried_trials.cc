#include "fitting/carried_trials.h"

#include <algorithm>
#include <utility>

#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

// Leaves out the train trials that a fit's values do not let be simulated.
void LeaveOut(const FitResult& fit, FitProblem& problem, std::vector<std::string>& left_out) {
  std::vector<TrialProblem> kept;
  std::vector<SharedPrior> priors;
  std::size_t train = 0;
  for (TrialProblem& trial : problem.trials) {
    bool carried = true;
    if (trial.role == TrialRole::kTrain) {
      TrialEvaluation e;
      TrialEvaluator(problem, trial).Evaluate({fit.shared, fit.initial_states[train++]}, e);
      carried = e.complete;
    }
    if (carried) {
      kept.push_back(std::move(trial));
      continue;
    }
    left_out.push_back(trial.file);
    priors.insert(priors.end(), trial.shared_priors.begin(), trial.shared_priors.end());
  }
  KeepPriors(priors, kept);
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

void KeepPriors(const std::vector<SharedPrior>& of_left_out, std::vector<TrialProblem>& trials) {
  const auto first = std::find_if(trials.begin(), trials.end(), [](const TrialProblem& t) {
    return t.role == TrialRole::kTrain;
  });
  if (first == trials.end()) return;
  first->shared_priors.insert(first->shared_priors.end(), of_left_out.begin(), of_left_out.end());
}

}  // namespace hoplab
