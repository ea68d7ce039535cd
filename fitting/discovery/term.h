#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/formula/formula_effect.h"

namespace hoplab {

/// Bounds of a term's coefficient, in the sizes expected of it.
inline constexpr double kCoefficientBound = 1e3;

/// A power of a variable that a term is made of, whose exponent may be freed.
struct TermPower {
  std::string base;     // "speed", "abs(vy)"
  std::string rest;     // what stands beside it, "sign(vy)"; empty: nothing
  std::string unit;     // of the base
  double exponent = 1;  // as the term has it
  double scale = 1.0;   // of the base, its natural one
};

/// What a term has inside beside its coefficient: held parameters on a grid, such as a limit or a
/// frequency. They are the source's parameters after the first.
struct TermShape {
  std::string family;         // terms of one family differ in their shape alone
  std::vector<double> steps;  // of the grid
};

/// One term of the library: a coefficient times a product of what is known at its place.
struct Term {
  const Effect* effect = nullptr;
  std::string words;  // "with the square of speed", completes "a force ... that grows"
  std::string phase;  // "", "in flight", "in stance", "while it is loaded", "... unloaded"
  std::vector<std::string> variables;  // that it is made of
  std::optional<TermPower> power;
  std::optional<TermShape> shape;
};

/// The term with its exponent free: c rest (base/scale)^p, p within [0.3, 4].
FormulaSource WithFreeExponent(const Term& term);

/// The term with its shape free, within one and a half steps of the grid.
FormulaSource WithFreeShape(const Term& term);

/// The term with its shape elsewhere.
Term AtShape(const Term& term, std::span<const double> shape);

/// Two terms of one family whose shapes are within `steps` of the grid of each other.
bool AreNeighbours(const Term& a, const Term& b, double steps);

}  // namespace hoplab
