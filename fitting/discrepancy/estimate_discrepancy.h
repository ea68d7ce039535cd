#pragma once

#include <vector>

#include "fitting/discrepancy/restricted_likelihood.h"

namespace hoplab {

/// The noise that suits a model's residuals best.
struct DiscrepancyEstimate {
  NoiseModel noise;             // white where no discrepancy pays
  double log_likelihood = 0.0;  // restricted, of `noise` [nats]
  double white = 0.0;           // of white noise
  double gain() const { return log_likelihood - white; }
};

/// A discrepancy whose restricted likelihood gains less than this over white noise is none [nats].
/// One amplitude at its bound gains it by chance in one case of twenty (half chi-square 0, half 1:
/// Self and Liang 1987); two, with the time scale sought, in 16 of 90 (docs/decisions/0010).
inline constexpr double kDiscrepancyPays = 1.353;

/// Maximises the restricted likelihood over amplitudes and time scale, from a large and from a tiny
/// amplitude, since two maxima are common, and from `known` if it is no white noise. With
/// `known_only` from there alone.
DiscrepancyEstimate EstimateDiscrepancy(const RestrictedLikelihood& likelihood,
                                        const NoiseModel& known = {}, bool known_only = false);

}  // namespace hoplab
