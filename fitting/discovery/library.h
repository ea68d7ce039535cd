#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/problem.h"
#include "model/formula/formula_effect.h"

namespace hoplab {

/// Sizes of things in a dataset, which make terms comparable.
struct NaturalScales {
  double length = 0.1;  // the height covered [m]
  double speed = 1.0;   // of a fall from there [m/s]
  double time = 1.0;    // the longest trial [s]
  double force = 1.0;   // the weight [N]
};
NaturalScales ScalesOf(const FitProblem& problem);

/// A power of a variable that a term is made of, whose exponent may be freed.
struct TermPower {
  std::string base;     // "speed", "abs(vy)"
  std::string rest;     // what stands beside it, "sign(vy)"; empty: nothing
  std::string unit;     // of the base
  double exponent = 1;  // as the term has it
  double scale = 1.0;   // of the base, its natural one
};

/// One term of the library: a coefficient times a product of what is known at its place.
struct Term {
  const Effect* effect = nullptr;
  std::string words;  // "with the square of speed", completes "a force ... that grows"
  std::string phase;  // "", "in flight", "in stance", "while it is loaded", "... unloaded"
  std::vector<std::string> variables;  // that it is made of
  std::optional<TermPower> power;
};

/// The terms that make sense for a mechanism: for each place of a formula products of its variables
/// up to degree three, with signs and phases, made comparable by `scales`. No two have one formula.
std::vector<Term> TermLibrary(const FitProblem& problem, const NaturalScales& scales);

/// The term with its exponent free: c rest (base/scale)^p, p within [0.3, 4].
FormulaSource WithFreeExponent(const Term& term);

}  // namespace hoplab
