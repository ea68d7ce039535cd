#pragma once

#include <vector>

#include "fitting/diagnosis/linearisation.h"
#include "fitting/discovery/term.h"

namespace hoplab {

/// Places in `library` of the terms worth a refit, ascending: what is picked beside each other
/// under either noise, then what scores best alone; of one family of shapes no more than a few.
/// `leaders`: the terms that can be told from each other.
std::vector<int> Promising(const std::vector<Term>& library, const std::vector<int>& leaders,
                           const Linearisation& white, const Linearisation& colored);

/// Nats by which a term is less likely beforehand: a family of shapes is as likely as one term, and
/// its members share that.
double PriceOf(const Term& term, const std::vector<Term>& library);

/// The size of one column that explains the residuals best.
double ColumnSize(const Linearisation& at, int column);

}  // namespace hoplab
