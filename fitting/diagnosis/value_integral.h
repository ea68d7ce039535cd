#pragma once

#include <limits>
#include <vector>

#include "fitting/discrepancy/restricted_likelihood.h"

namespace hoplab {

/// Logarithm of the density of a value that lies `u` of its typical sizes from the one that changes
/// nothing: a mixture of normal densities of 0.03, 0.1, ... 30 typical sizes, so that neither a
/// tenth nor ten times the typical size is a surprise. Twice that where only one side is possible.
double LogSizePrior(double u, bool one_sided);

/// What is believed of one shared value beforehand, in typical sizes from what changes nothing.
struct ValuePrior {
  double at = 0.0;  // where it was linearised
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool one_sided = false;  // only one side of what changes nothing is possible
};

/// Logarithm of the integral of a linearised likelihood times the values' LogSizePrior between
/// their bounds. The prior is not taken at the optimum: where a value is known to no better than
/// its size, the prior falls by much over what the data leave open. As it is a mixture of normal
/// densities and the likelihood is normal, the integral is a sum of normal integrals,
///   sum over widths w of (1/7) int L(u) N(u_k; 0, w^2) du,
/// one value after the other, the best known first; each is a normal density with a weight,
/// and integral and moments of one that a bound cuts are those of the truncated normal
/// distribution (exact for one value, and where values on bounds are not correlated).
double LogValueIntegral(const ValueLikelihood& likelihood, const std::vector<ValuePrior>& priors);

}  // namespace hoplab
