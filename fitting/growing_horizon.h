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

/// Costs of the rounds of a search that ended; infinite where a round came to nothing.
using RoundCosts = std::vector<double>;

/// The same, and `costs` gets those of its rounds. Where `other` has the costs of another search of
/// the same trials, this one gives up (kGaveUp, no cost) after a round that fits clearly
/// worse: it is in another order of events, and later rows will not bring it back.
SolveResult GrowHorizonBeside(SolveRequest request, const RoundCosts& other, RoundCosts& costs);

/// The same from another place, for what the first search did not find: it gives up, too, after a
/// round that fits as well as the other's. There it is at the other's minimum, and later rounds
/// would be the other's.
SolveResult GrowHorizonElsewhere(SolveRequest request, const RoundCosts& other);

}  // namespace hoplab
