#pragma once

#include <string>
#include <vector>

#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab::testing {

/// Effects the diagnosis tests choose from, one of every kind; the catalogue may grow around them.
inline const std::vector<std::string> kSixEffects = {
    "air_drag",     "gravity_scale",        "leg_material_damping",
    "sensor_delay", "touchdown_angle_bias", "touchdown_loss"};

/// An effect with one parameter at a size.
inline EffectSpec EffectOfSize(const std::string& name, double size) {
  const Effect* effect = FindEffect(name);
  return {name, {{std::string(effect->info.parameters[0].name), size}}};
}

/// Where the data of a test come from.
struct World {
  std::vector<EffectSpec> effects = {};
  int train = 3, test = 1;
  int hops = 2;
  std::uint64_t seed = 5;
  double sigma_m = 0.001;
  double rate_hz = 100.0;
};

/// What a diagnosis is given: traces, and nominal values that are not the truth.
inline Dataset DatasetOf(const World& world) {
  Scenario s = HopScenario(world.hops);
  s.effects = world.effects;
  s.dataset->sample_rate_hz = world.rate_hz;
  for (ChannelSpec& c : s.dataset->channels) c.sigma = world.sigma_m;
  std::vector<GenerateTrial>& trials = s.dataset->trials;
  trials.erase(trials.begin() + 6 + world.test, trials.end());
  trials.erase(trials.begin() + world.train, trials.begin() + 6);
  GenerateOptions options;
  options.seed = world.seed;
  Dataset d = GenerateDataset(s, options).dataset;
  const auto set_nominal = [](MechanismSpec& m) {
    m.c_leg.E_Pa = 20e9;
    m.c_leg.damping_N_s_per_m = 1.0;
  };
  for (Trial& t : d.trials) set_nominal(t.mechanism);
  set_nominal(d.mechanism);
  return d;
}

inline constexpr double kDragHopsSigma = 1e-3;  // m
// Hops with drag of another size in each trial.
inline Dataset HopsWithDrag(const std::vector<double>& train, const std::vector<double>& test,
                            std::uint64_t seed) {
  Dataset all;
  for (std::size_t i = 0; i < train.size() + test.size(); ++i) {
    const bool held_out = i >= train.size();
    const double size = held_out ? test[i - train.size()] : train[i];
    Dataset one = DatasetOf({.effects = {EffectOfSize("air_drag", size)},
                             .train = 6,
                             .test = 2,
                             .seed = 100 * seed + i,
                             .sigma_m = kDragHopsSigma});
    one.effects.clear();
    Trial trial = one.trials[i % one.trials.size()];
    trial.role = held_out ? TrialRole::kTest : TrialRole::kTrain;
    trial.file = (held_out ? "test-" : "train-") + std::to_string(i + 1) + ".csv";
    if (i == 0) {
      all = one;
      all.trials.clear();
    }
    all.trials.push_back(trial);
  }
  return all;
}

inline Candidate CandidateOf(const std::string& name) { return {FindEffect(name)}; }

inline std::vector<Candidate> CandidatesOf(const std::vector<std::string>& names) {
  std::vector<Candidate> candidates;
  for (const std::string& name : names) candidates.push_back(CandidateOf(name));
  return candidates;
}

/// A dataset fitted without any effect, as a diagnosis begins.
struct NullFit {
  FitProblem problem;
  std::vector<TrialProblem> train;
  FittedModel null;     // under white noise
  FittedModel settled;  // under the noise that suits it

  explicit NullFit(const Dataset& dataset, const ProblemOptions& options = {})
      : problem(MakeProblem(dataset, options)), train(TrialsOf(problem, TrialRole::kTrain)) {
    const FitResult fit = Fit(problem, {});
    null.problem = problem;
    null.shared = fit.shared;
    null.initial_states = fit.initial_states;
    null.cost = fit.cost;
    null.status = fit.records.at(static_cast<std::size_t>(fit.best_start)).status;
    null.complete = fit.stop.complete;
    settled = null;
    Settle(settled, Settings());
    Settle(null, SettingsOf(Discrepancy::kNone));
  }
  explicit NullFit(const World& world) : NullFit(DatasetOf(world)) {}

  Linearisation With(const std::vector<Candidate>& tested) const {
    return Linearised(null, tested);
  }
  Linearisation Linearised(const FittedModel& model, const std::vector<Candidate>& tested) const {
    const FitProblem extended = Extend(model.problem, tested);
    Eigen::VectorXd shared(extended.shared_count());
    shared << model.shared, NullValues(tested);
    return Linearise(extended, model.problem.shared_count(), train, shared, model.initial_states,
                     1);
  }
  FittedModel RefittedWith(const Candidate& candidate) const {
    return RefittedWith(candidate,
                        ScoreOf(With({candidate}), HypothesesOf(std::array{candidate})[0]).size);
  }
  FittedModel RefittedWith(const Candidate& candidate, const Eigen::VectorXd& size) const {
    return Refit(null, std::array{candidate}, size, Settings());
  }
  RefitSettings Settings() const { return SettingsOf(Discrepancy::kMatern); }
  RefitSettings SettingsOf(Discrepancy discrepancy) const {
    RefitSettings settings;
    settings.train = &train;
    settings.discrepancy = discrepancy;
    return settings;
  }
  NullFits fits() const { return {&null, &settled}; }
};

/// The same effect under another name: nothing can tell the two apart.
class Twin {
 public:
  Twin(const std::string& of, const char* name) : effect_(*FindEffect(of)) {
    effect_.info.name = name;
  }
  Twin(const Twin&) = delete;
  Twin& operator=(const Twin&) = delete;
  const Effect* effect() const { return &effect_; }
  Candidate candidate() const { return {&effect_}; }

 private:
  Effect effect_;
};

inline DiagnosisOptions OptionsWith(std::vector<std::string> candidates) {
  DiagnosisOptions options;
  options.candidates.only = std::move(candidates);
  return options;
}

/// How many sizes are told to differ between trials.
inline int SizesToldToDiffer(const Diagnosis& d) {
  int told = 0;
  if (!d.extension) return told;
  for (const CauseReport* c : d.extension->ToldCauses())
    for (std::size_t k = 0; k < c->sizes.size(); ++k) told += d.extension->TellsSizesOf(*c, k);
  return told;
}

/// Names of the first group: the leading cause first.
inline std::vector<std::string> GroupNames(const Naming& naming, std::size_t group = 0) {
  std::vector<std::string> names;
  if (group >= naming.groups.size()) return names;
  for (int i : naming.groups[group])
    names.push_back(naming.candidates[static_cast<std::size_t>(i)].candidate.Name());
  return names;
}

}  // namespace hoplab::testing
