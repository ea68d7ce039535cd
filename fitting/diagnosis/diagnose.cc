#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "datasets/suspect_things.h"
#include "fitting/check.h"
#include "fitting/diagnosis/after_verdict.h"
#include "fitting/diagnosis/believe.h"
#include "fitting/diagnosis/carry_on.h"
#include "fitting/diagnosis/diagnosis.h"
#include "fitting/diagnosis/null_fit.h"
#include "fitting/diagnosis/odd_channel.h"
#include "fitting/diagnosis/verdict.h"
#include "fitting/followed_part.h"
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

// Diagnoses `problem`, by finer steps where its derivatives cannot be trusted with the usual ones.
template <class Diagnosing>
Diagnosis WithStepsThatServe(FitProblem& problem, const DiagnosisOptions& options,
                             const Diagnosing& diagnose) {
  Diagnosis d = diagnose();
  const bool can_be_finer = problem.integrator.relative_tolerance > kFinerSteps.relative_tolerance;
  if (!d.gate.OnlyGradientsFailed() || !can_be_finer || d.interrupted) return d;
  if (options.stage) options.stage("again with finer steps: " + d.refusal);
  problem.integrator.relative_tolerance = kFinerSteps.relative_tolerance;
  problem.integrator.absolute_tolerance =
      std::min(problem.integrator.absolute_tolerance, kFinerSteps.absolute_tolerance);
  return diagnose();
}

class StageByStage {
 public:
  StageByStage(FitProblem whole, const DiagnosisOptions& options)
      : whole_(std::move(whole)), options_(options) {}

  // Longer and longer parts, as long as something is seen that has no sure name and longer ones
  // make it surer, each beginning with what the last one found; where nothing is seen, the whole
  // trials; where these cannot be judged and fit, what the first ones said stays. Where no
  // simulation follows the first one, shorter ones first.
  Diagnosis Run() {
    std::optional<Diagnosis> last;
    for (Parts parts(whole_); parts.IsLeft();) {
      Diagnosis longer =
          WithStepsThatServe(whole_, options_, [&] { return OfFirst(parts.until(), last); });
      if (longer.interrupted) return CutShort(std::move(last), std::move(longer));
      if (const std::string why = WhyNoVerdict(longer, parts); !why.empty()) {
        if (options_.stage) options_.stage("no verdict of that: " + why);
        parts.Fails();
        continue;
      }
      const bool nothing_seen = longer.verdict == Verdict::kAdequate;
      Tell(longer);
      if (IsLessSure(longer, last)) return WithWholeTrials(std::move(*last), whole_, options_);
      last = std::move(longer);
      if (last->verdict == Verdict::kNamed)
        return WithWholeTrials(std::move(*last), whole_, options_);
      if (nothing_seen && WholeIsMinimum()) break;
      parts.Follows();
    }
    if (last && !WholeIsMinimum() && !Stopped())
      return WithWholeTrials(std::move(*last), whole_, options_);
    DiagnosisOptions late = options_;
    const bool nothing_early = last && last->verdict == Verdict::kAdequate;
    if (nothing_early) late.max_effects = std::min(late.max_effects, kMostLateOnes);
    const bool far_off = IsFarOff(WholeNull());
    Diagnosis whole = WithStepsThatServe(whole_, late, [&] {
      Beforehand found = FoundIn(last, whole_);
      found.nothing_seen = nothing_early;
      return DiagnoseFitted(WholeNull(), late, found);
    });
    if (late.max_effects < options_.max_effects && whole.extension)
      whole.notes.push_back("nothing is seen in the first stances, so no more than " +
                            std::to_string(late.max_effects) +
                            " causes together are told of the whole trials");
    if (whole.interrupted) return CutShort(std::move(last), std::move(whole));
    if (nothing_early && !whole.refusal.empty() && !far_off) {
      last->notes.push_back("the whole trials have no verdict of their own: " + whole.refusal);
      return std::move(*last);
    }
    const bool keeps_last = !whole.refusal.empty() || IsLessSure(whole, last);
    if (last && NamesSomething(*last) && keeps_last)
      return WithWholeTrials(std::move(*last), whole_, options_);
    return whole;
  }

 private:
  bool Stopped() const { return options_.fit.IsStopped(); }
  // What is left of the whole trials is no detail.
  static bool IsFarOff(const DatasetFit& null) {
    constexpr double kFarOff = 1.5;  // squares of the noise, a sample
    long samples = 0;
    for (const TrialProblem& t : null.problem.trials)
      samples += t.role == TrialRole::kTrain ? t.sample_count : 0;
    return !null.result.ok || !(2.0 * null.result.cost <= kFarOff * static_cast<double>(samples));
  }
  // A verdict stays where somebody waits for no longer parts; that nothing is seen in the first
  // stances is none, but it is told.
  static Diagnosis CutShort(std::optional<Diagnosis> last, Diagnosis interrupted) {
    if (last && last->verdict == Verdict::kAdequate && last->until)
      interrupted.notes.push_back("the first " + WithTwoDecimals(*last->until) +
                                  " s of each trial show nothing that is missing");
    if (!last || last->verdict == Verdict::kAdequate) return interrupted;
    last->cut_short = true;
    last->notes.emplace_back("stopped: what longer parts of the trials say was not looked at");
    return std::move(*last);
  }
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
    if (!d.extension) return 1.0 - d.naming.unlisted_probability;
    const double told = d.extension->ToldProbability();
    return d.extension->IsBeyondPhysics() ? std::min(told, kMostAtBound) : told;
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
    const bool fits_steps = whole_null_ && whole_null_->problem.integrator.relative_tolerance ==
                                               whole_.integrator.relative_tolerance;
    if (!fits_steps) whole_null_ = FitPlain(whole_, options_, Segmentation::kWhole);
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
    found.begin.push_back(CarryOn(*last, problem, options_).model);
    // What could not be told from a cause there may be told from it here, or again not.
    for (const std::vector<FittedModel>& places : last->naming.rivals)
      for (std::size_t i = 1; i < places.size() && !Stopped(); ++i)
        found.begin.push_back(CarryOnRival(places[i], *last, problem, options_).model);
    std::erase_if(found.begin, [](const FittedModel& model) { return !model.ok(); });
    return found;
  }
  static bool SlowOnesWereNotNeeded(const Naming& naming) {
    return std::all_of(
        naming.candidates.begin(), naming.candidates.end(), [](const CandidateResult& c) {
          return !c.candidate.effect->info.slow || c.status == CandidateStatus::kNotNeeded;
        });
  }

  FitProblem whole_;
  const DiagnosisOptions& options_;
  std::optional<DatasetFit> whole_null_;
};

Diagnosis DiagnoseAtOnce(const Dataset& dataset, const DiagnosisOptions& options) {
  FitProblem problem = MakeProblem(dataset, WithLegsAlike(options.problem));
  const std::vector<std::string> notes = CorrectNoise(problem);
  Diagnosis d = WithStepsThatServe(problem, options, [&] {
    return DiagnoseFitted(FitPlain(problem, options, options.span), options);
  });
  d.notes.insert(d.notes.begin(), notes.begin(), notes.end());
  return d;
}

}  // namespace

Diagnosis Diagnose(const Dataset& dataset, const DiagnosisOptions& options) {
  FitProblem problem = MakeProblem(dataset, WithLegsAlike(options.problem));
  // What is asked for by name is looked at before anything is computed.
  CandidatesOf(problem, options.candidates);
  Diagnosis d;
  std::vector<std::string> warnings = DataWarnings(dataset, problem);
  if (options.warned) options.warned(warnings);
  d.refusal = UnreadableTimes(dataset);
  if (!d.refusal.empty()) {
    d.problem = std::move(problem);
    d.warnings = std::move(warnings);
    return d;
  }
  const bool by_legs = TraitsOf(problem.law).lands_leg_by_leg;
  if (by_legs && options.span == Segmentation::kAuto) {
    const std::vector<std::string> notes = CorrectNoise(problem);
    d = StageByStage(std::move(problem), options).Run();
    d.notes.insert(d.notes.begin(), notes.begin(), notes.end());
  } else if (!by_legs && HasOtherSensors(dataset)) {
    d = DiagnoseWithOddChannel(dataset, options, DiagnoseAtOnce);
  } else {
    d = DiagnoseAtOnce(dataset, options);
  }
  if (d.extension && d.extension->IsBeyondPhysics()) BelieveLessAtBound(d.extension->causes);
  TellBesides(d, options);
  if (d.refusal.empty() &&
      d.problem.integrator.relative_tolerance < options.problem.integrator.relative_tolerance)
    d.notes.emplace_back(
        "simulated with finer steps than usual, since an event is met almost without crossing it");
  d.warnings = std::move(warnings);
  return d;
}

}  // namespace hoplab
