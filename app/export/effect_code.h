#pragma once

#include <string>

#include "model/formula/formula_effect.h"
#include "model/formula/formula_error.h"

namespace hoplab {

/// A formula as a compiled effect: the C++ file that docs/adding/effect.md writes by hand, of the
/// name model/effects/<name>.cc. It acts as the formula does, but for the corners of `abs`, `sign`,
/// `step`, `max`, `min` and `loading`: no event restarts the step at one. Throws InputError (place
/// `place`) where a compiled effect does not know a variable of the formula.
std::string EffectCodeOf(const FormulaSource& source, const std::string& place);

/// The variables of this formula that a compiled effect does not know, by name; empty if there is a
/// file to write.
std::vector<std::string> UnknownToCode(const FormulaSource& source);

}  // namespace hoplab
