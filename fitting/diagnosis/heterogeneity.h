#pragma once

#include <vector>

#include "fitting/diagnosis/fitted_model.h"

namespace hoplab {

/// Whether trials agree on one shared value of a fitted model, to first order at the fit.
struct Heterogeneity {
  double chi2 = 0.0;
  int degrees_of_freedom = 0;  // trials that see it, less one
  double p_value = 1.0;        // of chi2 if they agree

  /// The value as N(mean, spread^2) over trials, the spread by restricted likelihood with every
  /// other shared value free; unit of the value. spread 0: one value serves all.
  /// (A value that is held is the mean.)
  double mean = 0.0, spread = 0.0;
  double gain = 0.0;  // nats of restricted likelihood over one value for all
  /// Minus the second derivative of the restricted log-likelihood by log spread, at spread; 0 where
  /// that is 0.
  double curvature = 0.0;
  std::vector<double> sizes;       // one a trial, shrunk towards the mean; NaN: it does not see it
  std::vector<double> std_errors;  // of the sizes, under the model's noise, the spread as given
};

/// One a shared value of `model`, under its noise.
std::vector<Heterogeneity> HeterogeneityOf(const FittedModel& model,
                                           const std::vector<TrialProblem>& train, int jobs);

/// The same of the one shared value at `place` where the trials of `train` have deviations of it
/// (fitting/deviation.h): their rows are moved back by the fitted deviations, so that nothing but
/// the shape of the trials' answers is taken to first order. Deviations of other values are each
/// trial's own. Mean and sizes are the best linear predictions under the model's noise.
Heterogeneity HeterogeneityAt(const FittedModel& model, const std::vector<TrialProblem>& train,
                              int place, int jobs);

}  // namespace hoplab
