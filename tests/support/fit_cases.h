#pragma once

#include "fitting/fit.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab::testing {

/// A dataset of generated hops cut to a few trials and a coarser rate: quick to fit.
inline Dataset SmallDataset(int train_trials = 2, int test_trials = 1, std::uint64_t seed = 3,
                            double rate_hz = 100.0) {
  Scenario s = HopScenario(2);
  s.dataset->sample_rate_hz = rate_hz;
  auto& trials = s.dataset->trials;
  trials.erase(trials.begin() + 6 + test_trials, trials.end());
  trials.erase(trials.begin() + train_trials, trials.begin() + 6);
  GenerateOptions options;
  options.seed = seed;
  Dataset d = GenerateDataset(s, options).dataset;
  for (Trial& t : d.trials) {
    t.mechanism.c_leg.E_Pa = 20e9;  // the nominal value of a fit is not the truth
    t.mechanism.c_leg.damping_N_s_per_m = 1.0;
  }
  d.mechanism.c_leg.E_Pa = 20e9;
  d.mechanism.c_leg.damping_N_s_per_m = 1.0;
  return d;
}

inline std::vector<OwnValues> NominalInitialStates(const std::vector<TrialProblem>& trials) {
  std::vector<OwnValues> initial_states;
  for (const TrialProblem& t : trials) initial_states.push_back(t.start);
  return initial_states;
}

/// A fit of SmallDataset, from off the truth (22 GPa, 3 N s/m).
struct SmallFit {
  FitProblem problem = MakeProblem(SmallDataset(), {});
  std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  SolveRequest Request() const {
    SolveRequest r;
    r.problem = &problem;
    r.trials = &trials;
    r.shared = Eigen::Vector2d(21e9, 2.0);
    r.initial_states = NominalInitialStates(trials);
    return r;
  }
};

}  // namespace hoplab::testing
