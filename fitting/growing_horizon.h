#pragma once

#include "fitting/solve.h"

namespace hoplab {

/// Solves on the first rows of the trials, then on more and more of them; each round begins where
/// the last one ended. What happens late in a trace turns with its start, so that a search over all
/// rows at once ends in another order of events; over the first rows there is one order.
/// `request` is that of all rows, with where to begin. The result is that of the last round, or of
/// the one that was interrupted.
SolveResult GrowHorizon(SolveRequest request);

}  // namespace hoplab
