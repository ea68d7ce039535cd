#pragma once

#include <string>
#include <vector>

#include "fitting/trial_errors.h"

namespace hoplab {

/// Trials that were fitted and are missed by far more than those held out.
struct TrainContrast {
  double train = 0.0, test = 0.0;  // chi-square a sample
  /// Train trials that a refit of their start alone, as that of a held-out trial, takes near the
  /// data: the search has not found these starts, so it ended at no minimum.
  std::vector<std::string> better_elsewhere;
  /// The fewest train trials without which the others are missed no more than the held-out ones,
  /// worst first; and their share of the misfit of all.
  std::vector<std::string> odd;
  double odd_share = 0.0;
  int train_trials = 0;

  /// Far more than the held-out ones: four times their chi-square a sample, and that of noise.
  bool IsFar() const;
  /// What speaks against a minimum; empty where nothing does.
  std::string Fault() const;
  /// Which trials do not go with the others; empty where none is missed by far more.
  std::string Warning() const;
};

/// Compares the complete trials of both roles, `trials` of AssessTrials. Nothing is far with fewer
/// than two of a role.
TrainContrast CompareRoles(const FitProblem& problem, const FitResult& fit,
                           const std::vector<TrialErrors>& trials, const FitOptions& options);

}  // namespace hoplab
