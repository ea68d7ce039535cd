#pragma once

#include "model/formula/formula.h"

namespace hoplab {

/// The effect that a formula is: simulated, differentiated and named like one of the catalogue.
/// Two equal sources are one effect, which lives as long as the program. Throws FormulaError for
/// what is not right: the formula, its parameters, or a formula that is not zero at their null.
const Effect& FormulaEffect(const FormulaSource& source);

/// The source of an effect that is a formula; null of one of the catalogue.
const FormulaSource* SourceOf(const Effect& effect);

/// Most parameters of a formula.
inline constexpr int kMostFormulaParameters = kMaxEffectParameters;

}  // namespace hoplab
