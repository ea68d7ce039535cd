#pragma once

#include "fitting/solve.h"

namespace hoplab {

/// Solves on the first rows of the trials, then on more and more of them; each round begins where
/// the last one ended. What happens late in a trace turns with its start, so that a search over all
/// rows at once ends in another order of events; over the first rows there is one order.
/// `request` is that of all rows, with where to begin: where that was fitted to the rows before
/// `known_until` [s], the first round goes beyond them. The result is that of the last round, or of
/// the one that was interrupted.
SolveResult GrowHorizon(SolveRequest request, double known_until = 0.0);

/// Where a round of a search ended, and at what cost; infinite where it came to nothing.
struct Round {
  double cost = 0.0;
  Eigen::VectorXd shared;
  bool operator==(const Round&) const = default;
};
using Rounds = std::vector<Round>;

/// The same, and `rounds` gets its rounds. Where `other` has those of another search of the same
/// trials and values, this one gives up (kGaveUp, no cost) after a round that fits clearly worse:
/// it is in another order of events, and later rows will not bring it back. It gives up, too, after
/// a round that ends at the other's values: later rounds would be the other's.
SolveResult GrowHorizonBeside(SolveRequest request, const Rounds& other, Rounds& rounds);

/// The same from another place, for what the first search did not find: it gives up, too, after a
/// round that fits as well as the other's, whatever its values. There it is at the other's minimum,
/// and later rounds would be the other's.
SolveResult GrowHorizonElsewhere(SolveRequest request, const Rounds& other);

}  // namespace hoplab
