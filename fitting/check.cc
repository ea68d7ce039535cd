#include "fitting/check.h"

#include <algorithm>
#include <cmath>

#include "datasets/copied_trials.h"
#include "datasets/suspect_things.h"
#include "fitting/apex_segments.h"
#include "fitting/leg_starts.h"
#include "fitting/mixed_up_trials.h"
#include "fitting/run_end.h"
#include "fitting/smoothed_traces.h"
#include "fitting/stance_torques.h"
#include "fitting/turned_axes.h"

namespace hoplab {
namespace {

TrialCheck CheckTrial(const FitProblem& problem, const TrialProblem& trial,
                      const Eigen::VectorXd& shared, bool& simulates) {
  const TrialEvaluator evaluator(problem, trial);
  TrialEvaluation e;
  evaluator.Evaluate({shared, trial.start, false}, e);
  simulates = e.complete;
  return {trial.file,
          trial.role,
          static_cast<long>(trial.row_times.size()),
          trial.sample_count,
          trial.row_times.back(),
          HopsInData(problem, trial),
          e.trajectory.outcome,
          e.trajectory.hops,
          e.trajectory.end_time};
}

bool TouchesGround(const TrialProblem& trial, const Trajectory& trajectory) {
  return std::any_of(trajectory.events.begin(), trajectory.events.end(),
                     [](const Event& e) { return e.kind != EventKind::kApex; }) ||
         trajectory.end_time < trial.row_times.back();
}

}  // namespace

std::vector<std::string> DataWarnings(const Dataset& dataset, const FitProblem& problem) {
  const Dataset compared =
      problem.keeps_stray ? dataset : WithoutFaults(dataset, problem.trace_faults);
  std::vector<std::string> warnings = SuspectThings(compared);
  for (const std::string& sentence : CopiedTrials(dataset)) warnings.push_back(sentence);
  if (!UnreadableTimes(dataset).empty()) return warnings;
  for (const auto& sentences :
       {TurnedAxes(problem), LegStarts(problem), LegTurns(problem), MixedUpTrials(problem),
        SmoothedTraces(problem), StanceTorques(problem)})
    for (const std::string& sentence : sentences)
      warnings.push_back(dataset.origin.place + ": " + sentence + ".");
  return warnings;
}

namespace {

// What is wrong with the trial's simulation, said of it.
std::string FaultOfSimulation(const FitProblem& problem, const TrialProblem& trial,
                              const TrialCheck& check) {
  if (IsComplete(check.outcome)) return "makes other contacts than the trace shows";
  Trajectory ended;
  ended.outcome = check.outcome;
  ended.end_time = check.end_time_s;
  const std::span<const double> start(trial.start.data(),
                                      static_cast<std::size_t>(trial.start.size()));
  return WhyEnded(ended, problem.effects, start) + ", at " +
         std::to_string(check.end_time_s).substr(0, 5) + " s of " +
         std::to_string(check.duration_s).substr(0, 5) + " s";
}

// As the other warnings name it: where its dataset.yaml lies, "datasets/rig-drops/".
std::string FolderOf(const Dataset& dataset) {
  const std::string& place = dataset.origin.place;
  return place.empty() ? dataset.name + "/" : place.substr(0, place.rfind('/') + 1);
}

}  // namespace

CheckReport CheckDataset(const Dataset& dataset, const FitProblem& problem, int jobs) {
  CheckReport report;
  report.warnings = DataWarnings(dataset, problem);
  report.notes = problem.notes;
  const Eigen::VectorXd shared = InitialShared(problem);
  std::vector<TrialProblem> simulated;
  std::vector<OwnValues> initial_states;
  bool any_touches = false;
  const std::string folder = FolderOf(dataset);
  for (const TrialProblem& trial : problem.trials) {
    bool simulates = false;
    const TrialCheck check = CheckTrial(problem, trial, shared, simulates);
    if (!simulates)
      report.warnings.push_back(folder + trial.file + ": at the nominal values the simulation " +
                                FaultOfSimulation(problem, trial, check) + ".");
    if (trial.role == TrialRole::kTrain) {
      Trajectory trajectory;
      TrialEvaluator(problem, trial)
          .Simulate({shared, trial.start, false}, problem.integrator, trajectory);
      const bool touches = TouchesGround(trial, trajectory);
      any_touches = any_touches || touches;
      if (!touches) {
        report.warnings.push_back(
            folder + trial.file +
            ": the body never touches the ground within the trace, so this trial says nothing "
            "about the leg. Record longer, or start lower.");
      }
      if (simulates) {
        simulated.push_back(trial);
        initial_states.push_back(trial.start);
      }
    }
    report.trials.push_back(check);
  }
  if (!simulated.empty()) {
    report.uncertainty = AssessUncertainty(problem, simulated, shared, initial_states, {}, jobs);
    report.certificate = CertifyGradients(problem, simulated, shared, initial_states, jobs);
  }
  return report;
}

}  // namespace hoplab
