#pragma once

#include <vector>

#include "fitting/discovery/scales.h"
#include "fitting/discovery/term.h"

namespace hoplab {

/// The terms that make sense for a mechanism: for each place of a formula products of its variables
/// up to degree three, with signs and phases, made comparable by `scales`. No two have one formula.
std::vector<Term> TermLibrary(const FitProblem& problem, const NaturalScales& scales);

}  // namespace hoplab
