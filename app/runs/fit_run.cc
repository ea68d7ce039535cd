#include "app/runs/fit_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/suspect_things.h"
#include "fitting/train_contrast.h"

namespace hoplab {
namespace {

bool IsFinished(const StartRecord& record) {
  return record.status == SolveStatus::kConverged || record.status == SolveStatus::kIterationLimit;
}

// Places of the shared values to profile.
std::vector<int> ProfileTargets(const FitProblem& problem, const std::vector<std::string>& wanted) {
  std::vector<int> targets;
  const std::vector<std::string> names = problem.shared_names();
  for (const std::string& name : wanted) {
    if (name == "all") {
      targets.clear();
      for (int i = 0; i < problem.shared_count(); ++i) targets.push_back(i);
      return targets;
    }
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
      throw InputError({"--profile", Printable(name), "is not a parameter of this fit",
                        DidYouMean(name, names)});
    const int target = static_cast<int>(at - names.begin());
    if (std::find(targets.begin(), targets.end(), target) != targets.end())
      throw InputError({"--profile", name, "is named twice", "Name it once."});
    targets.push_back(target);
  }
  return targets;
}

void Announce(const FitRunOptions& options, std::string_view stage) {
  if (options.stage) options.stage(stage);
}

void AddProfiles(const FitRunOptions& options, const std::vector<int>& targets, FitRun& run) {
  for (const int target : targets) {
    // Where the data say nothing, or the optimum sits on a bound, there is no width to step by.
    const SharedParameter& s = run.problem.shared[target];
    const ParameterUncertainty& known = run.uncertainty->parameters[target];
    const double step = known.std_error.value_or(0.1 * s.scale);
    Announce(options, "profile of " + s.name);
    Profile profile =
        ComputeProfile(run.problem, run.fit, options.fit, target, step, known.inflation);
    if (options.fit.IsStopped()) return;  // this one is cut short
    run.profiles.push_back(std::move(profile));
  }
}

void AddObjectives(const FitOptions& fit, const std::vector<TrialProblem>& train, FitRun& run) {
  std::vector<OwnValues> nominal;
  for (const TrialProblem& trial : train) nominal.push_back(trial.start);
  run.at_nominal = EvaluateObjective(run.problem, train, InitialShared(run.problem), nominal,
                                     fit.loss, fit.jobs, /*matrices=*/false);
  run.at_optimum = EvaluateObjective(run.problem, train, run.fit.shared, run.fit.initial_states,
                                     fit.loss, fit.jobs,
                                     /*matrices=*/false);
}

// A search that has not found the starts of its trials is at no minimum; trials that do not go with
// the others are told.
void AddTrainContrast(const FitOptions& options, FitRun& run) {
  const TrainContrast contrast = CompareRoles(run.problem, run.fit, run.trials, options);
  if (const std::string fault = contrast.Fault(); !fault.empty())
    run.faults.push_back(fault);
  else if (const std::string warning = contrast.Warning(); !warning.empty())
    run.warnings.push_back(warning);
}

// Where the model misses the data by much, the least cost lies at an edge, where events change
// their order, and a search creeps along it. What it has not gained yet is told; it is no fault
// where it moves no value beyond what its interval says.
void ForgivePromises(const Uncertainty& uncertainty, FitRun& run) {
  if (run.faults.empty()) return;
  Eigen::VectorXd errors(run.problem.shared_count());
  for (int k = 0; k < run.problem.shared_count(); ++k)
    errors[k] =
        uncertainty.parameters[static_cast<std::size_t>(k)].std_error.value_or(std::nan(""));
  const std::optional<double> most = run.fit.stop.PromisedErrors(errors, run.fit.cost);
  if (!most || *most >= kOfNoConsequence) return;
  run.note += fmt::format("{}{}, which moves no value by more than {:.2g} standard errors",
                          run.note.empty() ? "" : "; ", run.faults.front(), *most);
  run.faults.clear();
}

}  // namespace

std::string_view NameOf(FitStanding standing) {
  switch (standing) {
    case FitStanding::kOk:
      return "ok";
    case FitStanding::kPartial:
      return "partial";
    case FitStanding::kStuck:
      return "stuck";
    case FitStanding::kFailed:
      return "failed";
  }
  return "";
}

FitStanding FitRun::Standing() const {
  if (interrupted || !has_result) return FitStanding::kFailed;
  if (!faults.empty()) return FitStanding::kStuck;
  if (AllUndetermined()) return FitStanding::kFailed;
  return left_out.empty() && !until ? FitStanding::kOk : FitStanding::kPartial;
}

int FitRun::finished_restarts() const {
  return static_cast<int>(std::count_if(fit.records.begin(), fit.records.end(), IsFinished));
}

bool FitRun::Undetermined(int parameter) const {
  if (!uncertainty) return true;
  const ParameterUncertainty& p = uncertainty->parameters[parameter];
  return !p.std_error && !p.at_bound;
}

bool FitRun::AllUndetermined() const {
  for (int i = 0; i < problem.shared_count(); ++i) {
    if (!Undetermined(i)) return false;
  }
  return true;
}

std::string FitRun::Failure() const {
  if (interrupted && !has_result) return "interrupted; no start had been finished";
  if (interrupted) {
    return "interrupted; the result is the best of " + std::to_string(finished_restarts()) +
           " finished start" + (finished_restarts() == 1 ? "" : "s");
  }
  if (!refusal.empty()) return refusal;
  if (!has_result) {
    return "the search led nowhere" + (fit.message.empty() ? "" : ": " + fit.message) +
           "; try --starts 8, other nominal values or another law";
  }
  if (!faults.empty())
    return "the search is stuck: " + faults.front() +
           "; try --starts 8, --span hops, other nominal values or another law";
  if (AllUndetermined())
    return "the data determine none of the parameters (" + Join(problem.shared_names()) + ")";
  return "";
}

std::string FitRun::Caveat() const {
  if (const std::string failure = Failure(); !failure.empty()) return failure;
  if (!left_out.empty() && !by_hop)
    return "left out, since no values found let it be simulated: " + Join(left_out);
  if (!left_out.empty())
    return fmt::format(
        "{} of {} train hops are left out, since no values found let them be "
        "simulated: {}",
        left_out.size(), left_out.size() + fit.initial_states.size(), Join(left_out));
  return why_in_part;
}

FitRun RunFit(const Dataset& dataset, const FitRunOptions& options) {
  FitRun run;
  run.problem = MakeProblem(dataset, options.problem);
  const std::vector<int> targets = ProfileTargets(run.problem, options.profile);
  Announce(options, "checking the dataset");
  run.check = CheckDataset(dataset, run.problem, options.fit.jobs);
  if (options.checked) options.checked(run.check);

  run.refusal = UnreadableTimes(dataset);
  if (!run.refusal.empty()) return run;

  Announce(options, "fitting " + Join(run.problem.shared_names()));
  DatasetFit fitted = FitDataset(dataset, options.problem, options.fit, options.span);
  run.problem = std::move(fitted.problem);
  run.fit = std::move(fitted.result);
  run.by_hop = fitted.by_hop;
  run.until = fitted.until;
  (run.until ? run.why_in_part : run.note) = std::move(fitted.note);
  run.left_out = std::move(fitted.left_out);
  run.interrupted = run.fit.interrupted;
  run.has_result = run.fit.ok && IsFinished(run.fit.records[run.fit.best_start]);
  if (!run.has_result) return run;
  run.faults = run.fit.stop.faults;

  // The assessment is short and runs to its end: a start refitted halfway would be a wrong error.
  Announce(options, "assessing the fit");
  FitOptions to_the_end = options.fit;
  to_the_end.stop = nullptr;
  const std::vector<TrialProblem> train = TrialsOf(run.problem, TrialRole::kTrain);
  run.trials = AssessTrials(run.problem, run.fit, to_the_end);
  AddTrainContrast(to_the_end, run);
  AddObjectives(options.fit, train, run);
  // Where a search is stuck there is nothing to be sure about.
  const bool may_be_sure =
      run.faults.empty() || (run.faults.size() == 1 && run.fit.stop.OnlyPromises());
  if (!may_be_sure) return run;
  Uncertainty uncertainty =
      AssessUncertainty(run.problem, train, run.fit.shared, run.fit.initial_states,
                        options.fit.loss, options.fit.jobs);
  ForgivePromises(uncertainty, run);
  if (!run.faults.empty()) return run;
  run.uncertainty = std::move(uncertainty);
  run.certificate = CertifyGradients(run.problem, train, run.fit.shared, run.fit.initial_states,
                                     options.fit.jobs);
  if (!run.interrupted) AddProfiles(options, targets, run);
  run.interrupted = run.interrupted || options.fit.IsStopped();
  return run;
}

}  // namespace hoplab
