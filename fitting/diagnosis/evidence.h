#pragma once

#include <vector>

#include "fitting/diagnosis/value_integral.h"
#include "fitting/discrepancy/estimate_discrepancy.h"

namespace hoplab {

/// Logarithm of the prior of a discrepancy: amplitudes half-normal, ten sigma wide; the logarithm
/// of the time scale uniform between what the data can tell. Density per logarithm of each.
double LogDiscrepancyPrior(const NoiseModel& noise, const RestrictedLikelihood& likelihood);

/// Prior probability that something acts that no list holds.
inline constexpr double kUnlistedPrior = 0.2;

/// What the data say for a model, all its values marginalised.
struct Evidence {
  double white = 0.0;        // log evidence with white noise [nats], at the values given
  double discrepancy = 0.0;  // the same with a discrepancy; -infinity where none was found
  /// Both, weighted by the prior probability of a discrepancy.
  double log_z() const;
  /// Probability that a discrepancy is there, given the model's set of causes.
  double discrepancy_probability() const;
};

/// The model linearised at fitted values, and the integral of its likelihood times all priors:
/// over initial states and shared values as in LogValueIntegral, over the discrepancy's own values
/// around the peak of that (IntegrateOverNoise, begun at `noise`). The values are those of least
/// squares, where the whitened rows have another optimum; so the linear model is asked how it goes
/// on from there, and the prior is that of where it leads. `coarse`, for the discrepancy's own
/// values, may be of averaged rows.
Evidence EvidenceOf(const FitProblem& problem, const Eigen::VectorXd& shared,
                    const RestrictedLikelihood& likelihood, const RestrictedLikelihood& coarse,
                    const NoiseModel& noise);

/// Widths of the prior of each shared value around where it is, in its scales: where the data say
/// less than that, no more than the prior is integrated over.
Eigen::VectorXd PriorWidths(const FitProblem& problem, const Eigen::VectorXd& shared);

}  // namespace hoplab
