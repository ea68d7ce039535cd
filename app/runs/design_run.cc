#include "app/runs/design_run.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/text.h"
#include "fitting/design/forecast.h"
#include "fitting/diagnosis/diagnosis.h"
#include "fitting/model_of_spec.h"

namespace hoplab {
namespace {

// The time of a search grows with the square of the number of rivals.
constexpr std::size_t kMostRivals = 4;
// Below it the recorded trials have told the causes apart [nats].
constexpr double kSettled = 0.05;

class Run {
 public:
  Run(const Dataset& dataset, const DesignRunOptions& options)
      : dataset_(dataset), options_(options) {}

  DesignRun Design() {
    if (options_.causes.empty() && options_.sharpen.empty())
      ByDiagnosis();
    else
      ByTask();
    if (Stopped() || !run_.failure.empty()) return Finish();
    run_.space =
        DefaultSpace(run_.separates ? run_.rivals.front().problem : run_.model.problem, train_);
    SetRanges(run_.space, options_.space, "--space");
    Search();
    return Finish();
  }

 private:
  bool Stopped() const { return options_.fit.IsStopped(); }
  void Stage(std::string_view text) const {
    if (options_.stage) options_.stage(text);
  }
  DesignRun Finish() {
    run_.interrupted = Stopped();
    return std::move(run_);
  }

  // ---- what to look for
  void ByTask() {
    FitProblem problem = MakeProblem(dataset_, WithLegsAlike(options_.problem));
    run_.separates = options_.sharpen.empty();
    const std::vector<Candidate> causes = Causes(problem);
    const int parameter = run_.separates ? 0 : Place(problem);
    CheckSpace(problem);
    if (!FitPlain(std::move(problem)) || Stopped()) return;
    RefitSettings settings = Settings();
    FittedModel null = plain_;
    Stage("looking for the noise that suits it");
    Settle(null, settings);
    if (!run_.separates) {
      run_.model = std::move(null);
      run_.parameter = parameter;
      return;
    }
    // They are told together with their probabilities, or not at all.
    std::vector<FittedModel> rivals;
    for (const Candidate& cause : causes) {
      if (Stopped()) return;
      Stage("refitting with " + cause.Name());
      rivals.push_back(FitWith(plain_, cause, null.problem.noise, settings));
      if (rivals.back().ok()) continue;
      run_.failure = "the model with " + cause.Name() + " cannot be fitted to the recorded trials";
      return;
    }
    if (rivals.size() == 1) rivals.push_back(std::move(null));
    run_.rivals = std::move(rivals);
    run_.probabilities = WeightsOf(run_.rivals);
  }

  // A range that cannot be is told before a long fit.
  void CheckSpace(const FitProblem& problem) const {
    DesignSpace space = DefaultSpace(problem, TrialsOf(problem, TrialRole::kTrain));
    SetRanges(space, options_.space, "--space");
  }

  std::vector<Candidate> Causes(const FitProblem& problem) const {
    std::vector<Candidate> causes;
    for (const std::string& name : options_.causes) {
      const Effect& effect = ResolveEffect(name, "--cause");
      CheckApplies(effect, problem.law, problem.leg_mass(), "--cause", problem.inputs(),
                   problem.robot_legs());
      problem.known.CheckOpen(effect, "--cause");
      const bool again = std::any_of(causes.begin(), causes.end(),
                                     [&](const Candidate& c) { return c.effect == &effect; });
      const bool simulated =
          std::any_of(problem.effects.begin(), problem.effects.end(),
                      [&](const EffectSetting& e) { return e.effect == &effect; });
      if (again || simulated)
        throw InputError({"--cause", name,
                          again ? "is given twice" : "is part of the model already (--with)",
                          "Name each cause once."});
      causes.push_back({&effect, {}, problem.known});
    }
    if (causes.size() > kMostRivals)
      throw InputError({"--cause", std::to_string(causes.size()) + " causes",
                        "must be at most " + std::to_string(kMostRivals),
                        "Name those that are hardest to tell apart."});
    return causes;
  }

  int Place(const FitProblem& problem) const {
    const std::vector<std::string> names = problem.shared_names();
    const auto at = std::find(names.begin(), names.end(), options_.sharpen);
    if (at == names.end())
      throw InputError({"--sharpen", Printable(options_.sharpen), "is no value that is fitted",
                        DidYouMean(options_.sharpen, names)});
    return static_cast<int>(at - names.begin());
  }

  bool FitPlain(FitProblem problem) {
    run_.notes = CorrectNoise(problem);
    Stage("fitting the model as it is");
    FitOptions white = options_.fit;
    white.discrepancy = Discrepancy::kNone;
    DatasetFit fit = FitTraces(std::move(problem), white, options_.span);
    run_.problem = fit.problem;
    run_.notes.insert(run_.notes.begin(), fit.problem.notes.begin(), fit.problem.notes.end());
    if (!fit.note.empty()) run_.notes.push_back(fit.note);
    if (Stopped()) return false;
    if (!fit.result.ok || !fit.result.stop.complete) {
      run_.failure = "the model cannot be fitted to the recorded trials" +
                     (fit.result.message.empty() ? "" : ": " + fit.result.message);
      return false;
    }
    train_ = TrialsOf(fit.problem, TrialRole::kTrain);
    plain_.problem = std::move(fit.problem);
    plain_.shared = fit.result.shared;
    plain_.initial_states = fit.result.initial_states;
    plain_.cost = fit.result.cost;
    plain_.status = fit.result.records[static_cast<std::size_t>(fit.result.best_start)].status;
    plain_.complete = true;
    return true;
  }

  RefitSettings Settings() const {
    RefitSettings settings;
    settings.train = &train_;
    settings.jobs = options_.fit.jobs;
    settings.stop = options_.fit.stop;
    settings.discrepancy = options_.fit.discrepancy;
    return settings;
  }

  void ByDiagnosis() {
    CheckSpace(MakeProblem(dataset_, WithLegsAlike(options_.problem)));
    DiagnosisOptions options;
    options.problem = options_.problem;
    options.fit = options_.fit;
    options.span = options_.span;
    options.stage = options_.stage;
    options.step = options_.step;
    Diagnosis d = Diagnose(dataset_, options);
    run_.problem = d.problem;
    run_.notes = d.notes;
    run_.failure = d.refusal;
    if (!d.refusal.empty() || d.interrupted) return;
    train_ = TrialsOf(d.problem, TrialRole::kTrain);
    for (std::size_t m = 0; m < d.naming.rivals.size(); ++m) {
      // A trial to come has a size of its own, which nobody knows.
      if (d.naming.rivals[m].size() < 2 || d.naming.best.has_own_sizes()) continue;
      run_.separates = true;
      run_.rivals = std::move(d.naming.rivals[m]);
      run_.rivals.resize(std::min(run_.rivals.size(), kMostRivals));
      run_.probabilities = d.naming.group_weights[m];
      run_.probabilities.resize(run_.rivals.size());
      double sum = 0.0;
      for (const double p : run_.probabilities) sum += p;
      for (double& p : run_.probabilities) p /= sum;
      run_.decision = "the diagnosis leaves " + run_.RivalNames();
      return;
    }
    run_.separates = false;
    run_.model =
        d.naming.best.members.empty() || d.naming.best.has_own_sizes() ? d.null : d.naming.best;
    run_.parameter = 0;
    run_.decision = "nothing needs separating (verdict " + std::string(NameOf(d.verdict)) + ")";
  }

  // ---- the search
  void Search() {
    Stage("searching the trial to record next");
    DesignSearchRequest request;
    request.space = run_.space;
    request.budget = options_.budget;
    request.seed = options_.fit.seed;
    request.map_size = options_.map_size;
    request.jobs = options_.fit.jobs;
    request.stop = options_.fit.stop;
    if (options_.step) {
      request.progress = [&](int done, int of) { options_.step("designs tried", done, of); };
    }
    if (run_.separates) {
      run_.even_odds = EntropyOf(run_.probabilities) < kSettled;
      const std::vector<double> even(run_.rivals.size(),
                                     1.0 / static_cast<double>(run_.rivals.size()));
      run_.search = SearchSeparating(run_.rivals, run_.even_odds ? even : run_.probabilities,
                                     train_, request);
    } else {
      run_.search = SearchSharpening(run_.model, run_.parameter, train_, request);
    }
    if (run_.search.best.empty() && !Stopped())
      run_.failure = "no design of this space can be simulated" +
                     std::string(run_.separates ? " under every cause" : "") + ": " +
                     (run_.search.tried.empty()
                          ? ""
                          : "the simulation " + run_.search.tried.front().failure->Sentence());
  }

  const Dataset& dataset_;
  const DesignRunOptions& options_;
  DesignRun run_;
  FittedModel plain_;
  std::vector<TrialProblem> train_;
};

}  // namespace

std::string DesignRun::RivalNames() const {
  std::vector<std::string> names;
  for (const FittedModel& rival : rivals) names.push_back(RivalName(rival));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

DesignRun RunDesign(const Dataset& dataset, const DesignRunOptions& options) {
  return Run(dataset, options).Design();
}

}  // namespace hoplab
