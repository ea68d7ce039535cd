#include "fitting/diagnosis/carry_on.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/random.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/null_fit.h"
#include "fitting/diagnosis/unconfirmed.h"
#include "fitting/growing_horizon.h"
#include "fitting/stop_check.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

CarriedOn GrownFrom(const FittedModel& named, const FitProblem& problem, double known_until,
                    const DiagnosisOptions& options) {
  CarriedOn carried;
  FittedModel& model = carried.model;
  model.members = named.members;
  model.problem = Extend(problem, model.members);
  const std::vector<TrialProblem> train = TrialsOf(problem, TrialRole::kTrain);
  SolveRequest request;
  request.problem = &model.problem;
  request.trials = &train;
  request.shared = named.shared;
  request.initial_states = named.initial_states;
  request.loss = options.fit.loss;
  request.jobs = options.fit.jobs;
  request.stop = options.fit.stop;
  SolveResult result = GrowHorizon(std::move(request), known_until);
  model.status = result.status;
  if (!IsUsable(result.status)) {
    carried.stop.faults.push_back(result.message);
    return carried;
  }
  model.shared = std::move(result.shared);
  model.initial_states = std::move(result.initial_states);
  model.cost = result.cost;
  model.complete = result.complete;
  carried.stop = CheckStop(model.problem, train, model.shared, model.initial_states,
                           options.fit.loss, options.fit.jobs);
  return carried;
}

using Interval = std::optional<std::pair<double, double>>;

void Hold(const Interval& other, Interval& interval) {
  if (!other || !interval) return;
  interval->first = std::min(interval->first, other->first);
  interval->second = std::max(interval->second, other->second);
}

// A smooth error that is left grows from landing to landing: then the whole trials know a value no
// better than their first parts do, and the interval holds what both say. Other models are those of
// the whole trials.
void HoldFirstParts(const Diagnosis& d, const DiagnosisOptions& options, Uncertainty& whole) {
  const FittedModel& best = d.naming.best;
  const Uncertainty first =
      AssessUncertainty(best.problem, TrialsOf(d.problem, TrialRole::kTrain), best.shared,
                        best.initial_states, options.fit.loss, options.fit.jobs);
  for (std::size_t k = 0; k < whole.parameters.size(); ++k) {
    Hold(first.parameters[k].ci95, whole.parameters[k].ci95);
    Hold(first.parameters[k].ci95_between_trials, whole.parameters[k].ci95_between_trials);
  }
}

// How well a minimum of the whole trials is known, under the noise that suits it.
void AssessItself(CarriedOn& carried, const FitProblem& whole, const DiagnosisOptions& options) {
  FittedModel& model = carried.model;
  const std::vector<TrialProblem> train = TrialsOf(whole, TrialRole::kTrain);
  if (!model.settled) Settle(model, SettingsOf(options, train));
  carried.uncertainty = AssessUncertainty(model.problem, train, model.shared, model.initial_states,
                                          options.fit.loss, options.fit.jobs);
}

// The same beside other models, and held out.
void AssessBesideOthers(CarriedOn& carried, const Diagnosis& d, const FitProblem& whole,
                        const DiagnosisOptions& options) {
  const FittedModel& model = carried.model;
  const std::vector<TrialProblem> train = TrialsOf(whole, TrialRole::kTrain);
  const std::vector<Candidate> others =
      CandidatesBeside(model, CandidatesOf(whole, options.candidates));
  const Linearisation at = LineariseAt(model, others, train, options.fit.jobs);
  std::vector<OtherModel> more = WithOneMoreOf(d.naming, model, at, others);
  Doubt(d.set_aside, more);
  HoldOtherModels(more, model, carried.uncertainty);
  if (!model.problem.noise.IsWhite()) HoldFirstParts(d, options, carried.uncertainty);
  carried.errors = MeasureHeldOut(model, options.fit.jobs);
}

// The whole trials without `members`: begun with what they were with them.
CarriedOn CarriedWithout(const CarriedOn& with, const std::vector<SetAside>& members,
                         const Diagnosis& d, const FitProblem& whole,
                         const DiagnosisOptions& options) {
  const std::vector<TrialProblem> train = TrialsOf(whole, TrialRole::kTrain);
  CarriedOn carried;
  carried.model = Without(with.model, members, whole, SettingsOf(options, train));
  const FittedModel& model = carried.model;
  if (model.ok())
    carried.stop = CheckStop(model.problem, train, model.shared, model.initial_states,
                             options.fit.loss, options.fit.jobs);
  const bool is_there = model.ok() && carried.stop.IsMinimum();
  return is_there ? carried : CarryOn(d, whole, options);
}

// The diagnosis without `members` and what the whole trials make of it; absent where these are not
// followed without them, or nobody waits for it.
std::optional<Diagnosis> WithWholeTrialsWithout(const std::vector<SetAside>& members,
                                                const Diagnosis& d, const CarriedOn& with,
                                                const FitProblem& whole,
                                                const DiagnosisOptions& options) {
  if (options.stage) options.stage("taking out what the whole trials do not confirm");
  Diagnosis less = DiagnosedWithout(d, members, options);
  const bool are_out = less.naming.best.members.size() < d.naming.best.members.size();
  if (!are_out || options.fit.IsStopped()) return std::nullopt;
  CarriedOn carried = CarriedWithout(with, members, less, whole, options);
  if (!carried.stop.IsMinimum() || options.fit.IsStopped()) return std::nullopt;
  AssessItself(carried, whole, options);
  AssessBesideOthers(carried, less, whole, options);
  if (options.fit.IsStopped()) return std::nullopt;
  less.carried_on = std::move(carried);
  return less;
}

// What is there stays where nobody waits for more.
void CutShort(const char* without, Diagnosis& d) {
  d.cut_short = true;
  d.notes.push_back(std::string("stopped: ") + without);
}

}  // namespace

CarriedOn CarryOnRival(const FittedModel& rival, const Diagnosis& last, const FitProblem& problem,
                       const DiagnosisOptions& options) {
  return GrownFrom(rival, problem, last.until.value_or(0.0), options);
}

// A search ends where a step would change the order of events, and begun elsewhere it passes.
CarriedOn CarryOn(const Diagnosis& last, const FitProblem& problem,
                  const DiagnosisOptions& options) {
  constexpr int kMoreSearches = 3;
  const FittedModel& named = last.naming.best;
  const double known_until = last.until.value_or(0.0);
  CarriedOn best = GrownFrom(named, problem, known_until, options);
  const auto take = [&](CarriedOn other) {
    const bool fits = other.model.ok() && (!best.model.ok() || other.model.cost < best.model.cost);
    if (fits) best = std::move(other);
  };
  if (!best.stop.IsMinimum() && !options.fit.IsStopped())
    take(GrownFrom(named, problem, 0.0, options));
  RandomStream random(options.fit.seed, 0);
  for (int k = 0; k < kMoreSearches && !best.stop.IsMinimum() && !options.fit.IsStopped(); ++k) {
    FittedModel beside = named;
    for (int i = 0; i < beside.shared.size(); ++i) {
      const auto place = static_cast<std::size_t>(i);
      const SharedParameter& s = named.problem.shared[place];
      const double error = last.extension->uncertainty.parameters[place].std_error.value_or(0.0);
      beside.shared[i] = std::clamp(beside.shared[i] + error * random.Normal(), s.lower, s.upper);
    }
    take(GrownFrom(beside, problem, known_until, options));
  }
  return best;
}

Diagnosis WithWholeTrials(Diagnosis d, const FitProblem& whole, const DiagnosisOptions& options) {
  if (!d.extension) return d;
  CarriedOn carried;
  if (!options.fit.IsStopped()) {
    if (options.stage) options.stage("carrying on to the whole trials");
    carried = CarryOn(d, whole, options);
  }
  if (options.fit.IsStopped()) {
    CutShort("what the whole trials say was not looked at", d);
    return d;
  }
  if (carried.stop.IsMinimum()) {
    AssessItself(carried, whole, options);
    const std::vector<SetAside> unconfirmed = Unconfirmed(d, carried);
    if (!unconfirmed.empty()) {
      auto less = WithWholeTrialsWithout(unconfirmed, d, carried, whole, options);
      if (less) return *std::move(less);
      if (options.fit.IsStopped())
        CutShort("what the whole trials do not confirm was not taken out", d);
    }
    AssessBesideOthers(carried, d, whole, options);
  }
  d.carried_on = std::move(carried);
  return d;
}

}  // namespace hoplab
