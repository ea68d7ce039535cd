#pragma once

#include <string>

#include "model/formula/formula_effect.h"

namespace hoplab {

/// A formula in one line as a book would have it: products without *, powers raised where Unicode
/// can, so that "-c * vx^2" is "-c vx²".
std::string LineOf(const Formula& formula);

/// The same typeset, as MathML: "F_x" and what is added to it.
std::string MathMlOf(const Formula& formula);

/// What a formula may use at its place, with units and meanings, what it is made of, and where the
/// solver stops at its corners; for a terminal.
std::string FormulaExplained(const Effect& effect, bool colours);

}  // namespace hoplab
