#pragma once

#include "fitting/diagnosis/fitted_model.h"

namespace hoplab {

/// `best` with member `m` replaced by `freed`, the same term with more of it free, fitted from
/// where `best` is. `c`: the coefficient of `freed` with which it is the term; its other parameters
/// are the term's at their null. `null_problem`: without members. Not usable where nothing could
/// be fitted.
FittedModel Freed(const FittedModel& best, std::size_t m, const Candidate& freed, double c,
                  const FitProblem& null_problem, const RefitSettings& settings);

}  // namespace hoplab
