#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/random.h"
#include "datasets/suspect_things.h"
#include "fitting/diagnosis/after_verdict.h"
#include "fitting/diagnosis/diagnosis.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/null_fit.h"
#include "fitting/diagnosis/verdict.h"
#include "fitting/followed_part.h"
#include "fitting/growing_horizon.h"
#include "fitting/stop_check.h"
#include "fitting/trial_evaluator.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

std::string WithTwoDecimals(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

// What shows in whole trials alone, where nothing is seen in the first stances, is a cause that
// needs time, or up to three. More of them stand for the model's own error, which grows.
constexpr int kMostLateOnes = 3;

class StageByStage {
 public:
  StageByStage(FitProblem whole, const DiagnosisOptions& options)
      : whole_(std::move(whole)), options_(options) {}

  // Longer and longer parts, as long as something is seen that has no sure name and longer ones
  // make it surer, each beginning with what the last one found; where nothing is seen, the whole
  // trials. Where no simulation follows the first one, shorter ones first.
  Diagnosis Run() {
    std::optional<Diagnosis> last;
    for (Parts parts(whole_); parts.IsLeft();) {
      Diagnosis longer = OfFirst(parts.until(), last);
      if (longer.interrupted) return longer;
      if (const std::string why = WhyNoVerdict(longer, parts); !why.empty()) {
        if (options_.stage) options_.stage("no verdict of that: " + why);
        parts.Fails();
        continue;
      }
      const bool nothing_seen = longer.verdict == Verdict::kAdequate;
      Tell(longer);
      if (IsLessSure(longer, last)) return WithWholeTrials(std::move(*last));
      last = std::move(longer);
      if (last->verdict == Verdict::kNamed) return WithWholeTrials(std::move(*last));
      if (nothing_seen && WholeIsMinimum()) break;
      parts.Follows();
    }
    if (last && !WholeIsMinimum() && !Stopped()) return WithWholeTrials(std::move(*last));
    DiagnosisOptions late = options_;
    const bool nothing_early = last && last->verdict == Verdict::kAdequate;
    if (nothing_early) late.max_effects = std::min(late.max_effects, kMostLateOnes);
    Diagnosis whole = DiagnoseFitted(std::move(WholeNull()), late, FoundIn(last, whole_));
    if (late.max_effects < options_.max_effects && whole.extension)
      whole.notes.push_back("nothing is seen in the first stances, so no more than " +
                            std::to_string(late.max_effects) +
                            " causes together are told of the whole trials");
    const bool keeps_last = !whole.refusal.empty() || IsLessSure(whole, last);
    if (last && NamesSomething(*last) && keeps_last && !whole.interrupted)
      return WithWholeTrials(std::move(*last));
    return whole;
  }

 private:
  bool Stopped() const { return options_.fit.stop && *options_.fit.stop; }
  // A model's own errors grow from landing to landing, too, and make names less sure again.
  static bool IsLessSure(const Diagnosis& longer, const std::optional<Diagnosis>& shorter) {
    return shorter && NamesSomething(*shorter) && Sureness(longer) < Sureness(*shorter);
  }
  // That nothing is seen before the first stances are over says nothing of a model that does not
  // follow these.
  static std::string WhyNoVerdict(const Diagnosis& d, const Parts& parts) {
    if (d.refusal.empty() && parts.IsShorterThanStances() && d.verdict == Verdict::kAdequate)
      return "nothing is seen so early";
    return d.refusal;
  }
  // Of the names, stand-ins aside: longer parts have more of them, and they are told in any case.
  // Where nothing is named, that nothing is there.
  static double Sureness(const Diagnosis& d) {
    return d.extension ? d.extension->ToldProbability() : 1.0 - d.naming.unlisted_probability;
  }
  void Tell(const Diagnosis& d) const {
    if (!options_.stage) return;
    std::string text = "up to there: " + std::string(NameOf(d.verdict));
    for (const CauseReport* c :
         NamesSomething(d) ? d.extension->ToldCauses() : std::vector<const CauseReport*>())
      text += ", " + c->cause.Name() + " (P " + WithTwoDecimals(c->group_probability) + ")";
    options_.stage(text);
  }
  DatasetFit& WholeNull() {
    if (!whole_null_) whole_null_ = FitPlain(whole_, options_, Segmentation::kWhole);
    return *whole_null_;
  }
  bool WholeIsMinimum() {
    const FitResult& result = WholeNull().result;
    return result.ok && result.stop.IsMinimum();
  }

  Diagnosis OfFirst(double until, const std::optional<Diagnosis>& last) const {
    const std::string what = "the first " + WithTwoDecimals(until) + " s of each trial";
    if (options_.stage) options_.stage("looking at " + what);
    const FitProblem part = FirstPart(whole_, until);
    DatasetFit null = FitPlain(part, options_, Segmentation::kWhole);
    null.until = until;
    null.note =
        "what is told is of " + what + ": what is wrong with a model grows from landing to landing";
    const Beforehand found = null.result.ok ? FoundIn(last, part) : Beforehand();
    return DiagnoseFitted(std::move(null), options_, found);
  }

  // What was found in shorter parts, for a search in longer ones.
  Beforehand FoundIn(const std::optional<Diagnosis>& last, const FitProblem& problem) const {
    Beforehand found;
    if (!last || !NamesSomething(*last) || Stopped()) return found;
    found.slow_ones_only_beside = SlowOnesWereNotNeeded(last->naming);
    FittedModel model = CarriedOver(*last, problem).model;
    if (model.ok()) found.begin = std::move(model);
    return found;
  }
  static bool SlowOnesWereNotNeeded(const Naming& naming) {
    return std::all_of(
        naming.candidates.begin(), naming.candidates.end(), [](const CandidateResult& c) {
          return !c.candidate.effect->info.slow || c.status == CandidateStatus::kNotNeeded;
        });
  }

  // What was found, fitted to longer parts of the same trials, more and more of them: beyond what
  // is known; where that leads to no minimum, from the first rows on, and from values that are as
  // likely. A search ends where a step would change the order of events, and begun elsewhere it
  // passes.
  CarriedOn CarriedOver(const Diagnosis& last, const FitProblem& problem) const {
    constexpr int kMoreSearches = 3;
    const FittedModel& named = last.naming.best;
    const double known_until = last.until.value_or(0.0);
    CarriedOn best = GrownFrom(named, problem, known_until);
    const auto take = [&](CarriedOn other) {
      const bool fits =
          other.model.ok() && (!best.model.ok() || other.model.cost < best.model.cost);
      if (fits) best = std::move(other);
    };
    if (!best.stop.IsMinimum() && !Stopped()) take(GrownFrom(named, problem, 0.0));
    RandomStream random(options_.fit.seed, 0);
    for (int k = 0; k < kMoreSearches && !best.stop.IsMinimum() && !Stopped(); ++k) {
      FittedModel beside = named;
      for (int i = 0; i < beside.shared.size(); ++i) {
        const auto place = static_cast<std::size_t>(i);
        const SharedParameter& s = named.problem.shared[place];
        const double error = last.extension->uncertainty.parameters[place].std_error.value_or(0.0);
        beside.shared[i] = std::clamp(beside.shared[i] + error * random.Normal(), s.lower, s.upper);
      }
      take(GrownFrom(beside, problem, known_until));
    }
    return best;
  }

  CarriedOn GrownFrom(const FittedModel& named, const FitProblem& problem,
                      double known_until) const {
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
    request.loss = options_.fit.loss;
    request.jobs = options_.fit.jobs;
    request.stop = options_.fit.stop;
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
                             options_.fit.loss, options_.fit.jobs);
    return carried;
  }

  Diagnosis WithWholeTrials(Diagnosis d) const {
    if (!d.extension || Stopped()) return d;
    if (options_.stage) options_.stage("carrying on to the whole trials");
    CarriedOn carried = CarriedOver(d, whole_);
    if (Stopped()) return d;
    if (carried.stop.IsMinimum()) {
      FittedModel& model = carried.model;
      const std::vector<TrialProblem> train = TrialsOf(whole_, TrialRole::kTrain);
      Settle(model, SettingsOf(options_, train));
      carried.uncertainty =
          AssessUncertainty(model.problem, train, model.shared, model.initial_states,
                            options_.fit.loss, options_.fit.jobs);
      const std::vector<Candidate> others =
          CandidatesBeside(model, CandidatesOf(whole_, options_.candidates));
      const Linearisation at = LineariseAt(model, others, train, options_.fit.jobs);
      std::vector<OtherModel> more = WithOneMoreOf(d.naming, model, at, others);
      Doubt(d.set_aside, more);
      HoldOtherModels(more, model, carried.uncertainty);
      carried.errors = MeasureHeldOut(model, options_.fit.jobs);
    }
    d.carried_on = std::move(carried);
    return d;
  }

  FitProblem whole_;
  const DiagnosisOptions& options_;
  std::optional<DatasetFit> whole_null_;
};

}  // namespace

Diagnosis Diagnose(const Dataset& dataset, const DiagnosisOptions& options) {
  FitProblem problem = MakeProblem(dataset, WithLegsAlike(options.problem));
  // What is asked for by name is looked at before anything is computed.
  CandidatesOf(problem, options.candidates);
  Diagnosis d;
  d.refusal = UnreadableTimes(dataset);
  if (!d.refusal.empty()) {
    d.problem = std::move(problem);
    return d;
  }
  const std::vector<std::string> notes = CorrectNoise(problem);
  const bool by_stages =
      TraitsOf(problem.law).lands_leg_by_leg && options.span == Segmentation::kAuto;
  d = by_stages ? StageByStage(std::move(problem), options).Run()
                : DiagnoseFitted(FitPlain(std::move(problem), options, options.span), options);
  TellBesides(d, options);
  d.notes.insert(d.notes.begin(), notes.begin(), notes.end());
  return d;
}

}  // namespace hoplab
