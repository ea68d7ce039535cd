#include "fitting/carried_beginnings.h"

#include <algorithm>
#include <cstdio>

#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr int kRoundsOfCuts = 4;
constexpr double kLeastKept = 0.75;  // of the train samples

long TrainSamples(const FitProblem& problem) {
  long samples = 0;
  for (const TrialProblem& t : problem.trials)
    samples += t.role == TrialRole::kTrain ? t.sample_count : 0;
  return samples;
}

// Cuts the trials of a role that are not simulated to their end at these values. False: a train
// trial has no beginning; such a test trial is left whole.
bool Cut(FitProblem& problem, TrialRole role, const FitResult& fit) {
  std::size_t train = 0;
  for (TrialProblem& trial : problem.trials) {
    if (trial.role != role) continue;
    TrialEvaluation e;
    const OwnValues& start = role == TrialRole::kTrain ? fit.initial_states[train++] : trial.start;
    TrialEvaluator(problem, trial).Evaluate({fit.shared, start, false}, e);
    if (e.complete) continue;
    const std::optional<TrialProblem> beginning = CarriedBeginning(problem, trial, e.trajectory);
    if (beginning)
      trial = *beginning;
    else if (role == TrialRole::kTrain)
      return false;
  }
  return true;
}

std::vector<std::string> EndsLeftOut(const FitProblem& whole, const FitProblem& cut) {
  std::vector<std::string> ends;
  for (std::size_t i = 0; i < whole.trials.size(); ++i) {
    const std::vector<double>& kept = cut.trials[i].row_times;
    if (kept.size() == whole.trials[i].row_times.size()) continue;
    char text[40];
    std::snprintf(text, sizeof text, " from %.3f s on",
                  whole.trials[i].begin_s + whole.trials[i].row_times[kept.size()]);
    ends.push_back(whole.trials[i].file + text);
  }
  return ends;
}

}  // namespace

std::optional<TrialProblem> CarriedBeginning(const FitProblem& problem, const TrialProblem& trial,
                                             const Trajectory& run) {
  // Contacts in another order than the data's are no fall.
  if (IsComplete(run.outcome)) return std::nullopt;
  double left = 0.0, landed = run.end_time;
  bool has_left = false;
  for (const Event& e : run.events) {
    if (e.kind == EventKind::kLiftoff || e.kind == EventKind::kBounce) {
      left = e.time;
      landed = run.end_time;
      has_left = true;
    } else if (e.kind == EventKind::kTouchdown) {
      landed = e.time;
    }
  }
  if (!has_left) return std::nullopt;
  TrialProblem beginning = FirstPart(problem, trial, 0.5 * (left + landed));
  if (beginning.row_times.size() == trial.row_times.size()) return std::nullopt;
  return beginning;
}

std::optional<BeginningsFit> FitBeginnings(const FitProblem& problem, const FitResult& result,
                                           const FitOptions& options) {
  BeginningsFit fit{problem, result, {}};
  const auto least = static_cast<long>(kLeastKept * static_cast<double>(TrainSamples(problem)));
  for (int round = 0; !fit.result.stop.complete; ++round) {
    if (round == kRoundsOfCuts || !fit.result.ok || fit.result.interrupted ||
        !Cut(fit.problem, TrialRole::kTrain, fit.result) || TrainSamples(fit.problem) < least)
      return std::nullopt;
    fit.result = Fit(fit.problem, options);
  }
  if (!fit.result.ok || !fit.result.stop.IsMinimum() ||
      !Cut(fit.problem, TrialRole::kTest, fit.result))
    return std::nullopt;
  fit.left_out = EndsLeftOut(problem, fit.problem);
  return fit;
}

}  // namespace hoplab
