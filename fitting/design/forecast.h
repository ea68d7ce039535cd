#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fitting/diagnosis/fitted_model.h"
#include "model/hybrid/automaton.h"

namespace hoplab {

/// What the recorded trials say about a model's shared values, their initial states projected out:
/// rows R with R'R the information, in units of the values' scales. Values on a bound count as
/// known.
struct RecordedInformation {
  std::vector<int> free;  // places of the shared values that are not on a bound
  Eigen::MatrixXd rows;   // one column a free value
};
RecordedInformation InformationOf(const FittedModel& model, const std::vector<TrialProblem>& train);

/// Why a design has no forecast.
struct ForecastFailure {
  std::optional<Outcome> outcome;  // of its simulation; none: no refit of the rival
  std::string under;               // the rival; empty where there is one model

  std::string Name() const;      // "fell_angle under air_drag"
  std::string Sentence() const;  // "fell: the leg tipped ... under air_drag"
};

/// What a trial is expected to say for rival models.
struct SeparationForecast {
  /// (i, j): log-likelihood by which j, refitted to old and new data, misses what i predicts in the
  /// new trial [nats].
  Eigen::MatrixXd nats;
  std::optional<ForecastFailure> failure;
};

/// By the linear model of each rival at its fitted values.
SeparationForecast ForecastLinearly(std::span<const FittedModel> rivals,
                                    std::span<const RecordedInformation> information,
                                    const TrialProblem& trial, int jobs);

/// By refits of each rival to the recorded trials and what each other one predicts, each under its
/// own noise.
SeparationForecast ForecastByRefits(std::span<const FittedModel> rivals,
                                    const std::vector<TrialProblem>& train,
                                    const TrialProblem& trial, int jobs);

/// Whether every rival predicts the trial to its end.
bool AllGetThrough(std::span<const FittedModel> rivals, TrialProblem trial);

/// Entropy of weights that add to one [nats].
double EntropyOf(std::span<const double> weights);

/// Logarithm of the entropy of `weights` that is expected to remain after a trial with such a
/// forecast, each rival in turn being true. Log-likelihood ratios are normal with mean d and
/// variance 2 d; of three rivals and more those to one truth are taken as fully correlated.
double LogExpectedEntropy(std::span<const double> weights, const Eigen::MatrixXd& nats);

/// Names of a rival's members: "air_drag + ground_slope", "none of them".
std::string RivalName(const FittedModel& rival);

/// Half width of a value's 95 % interval [its own unit] from the recorded trials alone, and with a
/// new one; infinite where the data do not determine it.
struct SharpeningForecast {
  double half_width = 0.0;
  std::optional<ForecastFailure> failure;
};
SharpeningForecast ForecastInterval(const FittedModel& model,
                                    const RecordedInformation& information, int parameter,
                                    const TrialProblem* trial);

}  // namespace hoplab
