#pragma once

#include <optional>
#include <vector>

#include "fitting/diagnosis/fitted_model.h"
#include "fitting/diagnosis/free_forces.h"
#include "fitting/discovery/scales.h"
#include "fitting/discovery/term.h"

namespace hoplab {

/// The size a variable of a place has in these data.
double NaturalSize(const VariableInfo& variable, const NaturalScales& scales);

/// What a variable of a place is drawn over: where the body was, else its natural size.
Extent DrawnOver(const VariableInfo& variable, const NaturalScales& scales);

/// What a formula adds where `variable` is `at`, in the phase in which it acts, other variables at
/// their natural sizes and its first parameter, the coefficient, `c`; shapes at their given values.
double FormulaAt(const Effect& effect, std::string_view variable, double at, double c,
                 const NaturalScales& scales);

/// What acts at a term's place over its variable, free of its formula: the formula as fitted, and
/// hats of even width, in the phase the term has, fitted to what `best` leaves; the term's
/// coefficient stays where it is, all other values are free. Nothing for a term of several
/// variables, of a frequency, which hats cannot follow, or of a reading over time, which may have
/// no corners.
std::optional<ReconstructedForce> FreeCurve(const Term& term, const FittedModel& best,
                                            const std::vector<TrialProblem>& train,
                                            const NaturalScales& scales, int jobs,
                                            std::uint64_t seed);

}  // namespace hoplab
