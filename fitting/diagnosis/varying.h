#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "fitting/diagnosis/fitted_model.h"

namespace hoplab {

/// A shared value that has a size of its own in each trial: N(mean, spread^2), in its unit.
struct VaryingValue {
  int place = 0;  // among the model's shared values
  double mean = 0.0, spread = 0.0;
  /// Of the mean: the wider of the two intervals of ParameterUncertainty, that of the noise and
  /// that of how differently trials pull, which knows how few they are. Absent on a bound.
  std::optional<std::pair<double, double>> ci95;
  std::vector<double> sizes;  // one a train trial, as fitted; NaN: it does not act there
  /// Of the best linear prediction of each size, the spread as given; NaN: the trial does not see
  /// it.
  std::vector<double> std_errors;
};

/// A model some of whose values differ between trials, fitted.
struct VaryingModel {
  FittedModel model;  // trials of its problem have deviations (fitting/deviation.h)
  std::vector<TrialProblem> train;
  std::vector<VaryingValue> values;  // those whose spread is not 0
  /// Every spread has come to rest. If not, nothing else is to be used.
  bool converged = false;
  int rounds = 0;
  double square = 0.0;  // squares of data over sigma and of priors, N(0, spread^2) of deviations
  /// Laplace's evidence, deviations integrated out under N(0, spread^2), spreads under LogSizePrior
  /// of one side [nats].
  double log_z = 0.0;
  /// `log_z` over that of the model with one size for all trials, whose shared values and noise
  /// have the same priors.
  double gain = 0.0;
};

/// Nats of evidence from which sizes that differ are told. The odds are 20 to 1 then: what is asked
/// to tell two causes apart, and to name one without a doubt. Beforehand one size and many are
/// alike likely.
inline constexpr double kVaryingPays = 3.0;

/// One size for all, as the search for different ones begins: under white noise, since the noise
/// that suits one size has taken the differences over.
FittedModel UnderWhiteNoise(FittedModel model);

/// Refits a settled model with a deviation of the shared values at `places` in each trial: shared
/// values, initial states and deviations by least squares, the spreads by the restricted likelihood
/// at the refit (HeterogeneityAt) under the noise that suits it, in turn until no spread changes by
/// three hundredths: of ten trials it is known to a quarter. A value whose spread comes to 0 has
/// one size again. `settings.train` are the trials `model` was fitted to.
VaryingModel RefitVarying(const FittedModel& model, const std::vector<int>& places,
                          const RefitSettings& settings);

/// The same of a model that has its deviations: fits it, and brings its spreads to rest. What the
/// trials of `settings` are is not looked at. `also`: as SettleNoise has it. Not `converged` where
/// some spread came to 0; then nothing else is to be used.
void BringToRest(VaryingModel& v, const RefitSettings& settings, const NoiseModel& also = {});

/// Gives the deviations the priors with which least squares find them. These weigh rows as if all
/// noise were white; a size is then drawn to the mean as it should be only where its prior is
/// narrower by as much as the discrepancy widens what one trial tells.
void SetRidges(VaryingModel& v);

}  // namespace hoplab
