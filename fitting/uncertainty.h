#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fitting/fit.h"

namespace hoplab {

/// How well one shared value is known. Absent where the data do not determine it.
struct ParameterUncertainty {
  /// Own unit, of least squares under the problem's noise: white, and the discrepancy there is.
  std::optional<double> std_error;
  /// value -+ 1.96 std_error, cut at the bounds; up to a bound where a value with a threshold fits
  /// as well there.
  std::optional<std::pair<double, double>> ci95;
  /// The same from the scatter between trials (sandwich estimate, Student's t): what counts when
  /// the model misses more than noise. Absent with fewer than 3 trials.
  std::optional<double> std_error_between_trials;
  std::optional<std::pair<double, double>> ci95_between_trials;
  /// Of a diagnosis: `ci95` if the told model were certain. There `ci95` and `ci95_between_trials`
  /// also hold the value of every model that the data leave nearly as likely (OtherModel), and what
  /// first parts of the trials said where a smooth error is left in the whole (CarriedOn).
  std::optional<std::pair<double, double>> ci95_given_model;
  /// The wider of the two 95 % intervals.
  const std::optional<std::pair<double, double>>& Wider() const;
  bool at_bound = false;
  /// The square of `std_error` over what white noise alone would give.
  double inflation = 1.0;
};

/// A combination of shared values the data say little about: moving along it by its loadings
/// (in units of each value's scale, length 1) changes the fit by `eigenvalue` per square.
struct WeakDirection {
  double eigenvalue;  // of the information matrix, initial states marginalised; 0: not seen at all
  std::vector<double> loadings;  // one a shared value
};

struct Identifiability {
  /// Of the shared values' information, in units of their scales: largest over smallest singular
  /// value of the whitened sensitivities, initial states projected out. Infinite when
  /// rank-deficient.
  double condition_number = 1.0;
  int rank = 0;                                // of the shared values' sensitivities
  std::vector<WeakDirection> weak_directions;  // weakest first
};

struct Uncertainty {
  std::vector<ParameterUncertainty> parameters;  // one a shared value
  Identifiability identifiability;
  Eigen::MatrixXd covariance;   // of the shared values, own units; NaN rows where undetermined
  Eigen::MatrixXd correlation;  // NaN where undetermined
  double chi2_per_dof = 0.0;    // whitened residuals and priors of the trials
  /// p-value of chi2 if the model were right and the noise as stated.
  double chi2_p_value = 1.0;
  /// The model misses more than the noise (p < 0.001): intervals from noise alone are too narrow.
  bool misfit = false;
};

/// A combination counts as weak if the data fix it no better than this many of its scales.
inline constexpr double kWeakStdError = 0.3;

/// Linearises `trials` (of `problem`) at given values. Trials whose simulation ends before their
/// data are left out.
Uncertainty AssessUncertainty(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                              const Eigen::VectorXd& shared,
                              const std::vector<OwnValues>& initial_states, const Loss& loss,
                              int jobs);

}  // namespace hoplab
