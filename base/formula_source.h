#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hoplab {

/// A parameter of a formula as it is written down.
struct FormulaParameter {
  std::string name;
  std::string unit;             // "N s/m"
  std::optional<double> null;   // where the formula is zero; absent: it only shapes the effect
  std::optional<double> value;  // where it has no null: what it is unless freed
  double lower = 0.0, upper = 0.0;
  std::optional<double> typical;  // size when the effect is there; absent: guessed from the bounds
  bool operator==(const FormulaParameter&) const = default;
};

/// An effect as a formula, as it is written down (format hoplab-effect/1).
struct FormulaSource {
  std::string name;
  std::string acts_as;  // "body_force_x"
  std::string formula;  // "-k * max(x - x_end, 0)"
  std::vector<FormulaParameter> parameters;
  std::string sentence;
  bool operator==(const FormulaSource&) const = default;
};

}  // namespace hoplab
