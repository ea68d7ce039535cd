#include "fitting/discovery/term.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace hoplab {

FormulaSource WithFreeExponent(const Term& term) {
  HOPLAB_CHECK(term.power.has_value());
  const TermPower& power = *term.power;
  FormulaSource source = *SourceOf(*term.effect);
  const FormulaParameter c = source.parameters.front();
  const std::string unit(FindPlace(source.acts_as)->unit);
  const double size = *c.typical * std::pow(power.scale, power.exponent);
  source.name += "_power";
  source.formula =
      "c * " + (power.rest.empty() ? "" : power.rest + " * ") + "(" + power.base + "/u)^p";
  source.parameters = {{"c", unit == "-" ? "1" : unit, 0.0, std::nullopt, -kCoefficientBound * size,
                        kCoefficientBound * size, size},
                       {"p", "1", power.exponent, std::nullopt, 0.3, 4.0, 0.5},
                       {"u", power.unit, std::nullopt, power.scale, 0.5 * power.scale,
                        2.0 * power.scale, std::nullopt}};
  return source;
}

FormulaSource WithFreeShape(const Term& term) {
  HOPLAB_CHECK(term.shape.has_value());
  FormulaSource source = *SourceOf(*term.effect);
  source.name += "_shape";
  for (std::size_t i = 1; i < source.parameters.size(); ++i) {
    FormulaParameter& p = source.parameters[i];
    p.null = p.value;
    p.value.reset();
    p.typical = term.shape->steps[i - 1];
    // Near by: further away is the start of another term of the grid.
    p.lower = std::max(p.lower, *p.null - 1.5 * *p.typical);
    p.upper = std::min(p.upper, *p.null + 1.5 * *p.typical);
  }
  return source;
}

Term AtShape(const Term& term, std::span<const double> shape) {
  FormulaSource source = *SourceOf(*term.effect);
  for (std::size_t i = 1; i < source.parameters.size(); ++i) {
    FormulaParameter& p = source.parameters[i];
    p.value = std::clamp(shape[i - 1], p.lower, p.upper);
  }
  Term moved = term;
  moved.effect = &FormulaEffect(source);
  return moved;
}

bool AreNeighbours(const Term& a, const Term& b, double steps) {
  if (!a.shape || !b.shape || a.shape->family != b.shape->family) return false;
  const auto &of_a = SourceOf(*a.effect)->parameters, &of_b = SourceOf(*b.effect)->parameters;
  for (std::size_t i = 1; i < of_a.size(); ++i) {
    if (std::abs(*of_a[i].value - *of_b[i].value) > steps * a.shape->steps[i - 1]) return false;
  }
  return true;
}

}  // namespace hoplab
