#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fitting/fit.h"

namespace hoplab {

/// Errors of one hop of one trial: the rows from one apex to the next.
struct HopErrors {
  double begin, end;         // s
  std::vector<double> rmse;  // per channel, its unit; NaN without samples
};

/// How a trial and its simulation differ at given shared values.
struct TrialErrors {
  std::string file;
  TrialRole role;
  Outcome outcome;
  double end_time;           // s, where the simulation ended
  bool complete;             // every datum has its simulated counterpart
  std::vector<double> rmse;  // per channel; NaN unless complete (never from fewer samples)
  double nll_per_sample;     // Gaussian, with the channels' sigma; NaN unless complete
  double chi2 = 0.0;         // of the data's whitened residuals
  long samples;
  /// Of each sample in turn, contacts last: its time, and - log density under the problem's noise
  /// given those before it, in units of its sigma [nats, but for log(2 pi)/2]; empty unless
  /// complete.
  std::vector<double> sample_times, sample_nll;
  double prior_nll = 0.0;  // of its own values, half the sum of squares under their priors
  std::vector<HopErrors> hops;
  OwnValues start;                    // fitted own values, those of the start first
  double max_deflection_ratio = 0.0;  // F C/l0; beyond 0.2 `large_deflection` is not to be trusted
  Trajectory trajectory;              // samples at the rows
};

/// Means over trials of one role.
struct RoleErrors {
  std::vector<double> rmse;  // per channel, over all samples of the role; NaN if any is incomplete
  double nll_per_sample;
  long samples;
  int trials, incomplete;
};

/// Errors at the fitted values. Train trials keep their fitted initial states; a test trial's start
/// is refitted under its prior with the shared values held (a nominal start may be off by more than
/// the model is).
/// With `test_only` nothing but the role and the file of a train trial is filled in. A robot's
/// starts are sought from those of `like` first, the errors of another model of these trials; where
/// that comes to no good end, as without it.
std::vector<TrialErrors> AssessTrials(const FitProblem& problem, const FitResult& fit,
                                      const FitOptions& options, bool test_only = false,
                                      const std::vector<TrialErrors>* like = nullptr);
RoleErrors Summarise(const FitProblem& problem, const std::vector<TrialErrors>& trials,
                     TrialRole role);

}  // namespace hoplab
