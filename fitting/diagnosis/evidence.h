#pragma once

#include <vector>

#include "fitting/discrepancy/estimate_discrepancy.h"

namespace hoplab {

/// Logarithm of the density of a value that lies `u` of its typical sizes from the one that changes
/// nothing: a mixture of normal densities of 0.03, 0.1, ... 30 typical sizes, so that neither a
/// tenth nor ten times the typical size is a surprise. Twice that where only one side is possible.
double LogSizePrior(double u, bool one_sided);

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

/// Laplace's approximation around fitted values: the restricted likelihood with the values' priors,
/// the half space where one lies on a bound, and the discrepancy's own values marginalised by the
/// curvature of the restricted likelihood.
/// `likelihood` has the values' PriorWidths; `coarse`, for the curvature, may be of averaged rows.
Evidence EvidenceOf(const FitProblem& problem, const Eigen::VectorXd& shared,
                    const RestrictedLikelihood& likelihood, const RestrictedLikelihood& coarse,
                    const NoiseModel& noise);

/// Widths of the prior of each shared value around where it is, in its scales: where the data say
/// less than that, no more than the prior is integrated over.
Eigen::VectorXd PriorWidths(const FitProblem& problem, const Eigen::VectorXd& shared);

}  // namespace hoplab
