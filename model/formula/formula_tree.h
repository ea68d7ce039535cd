#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

/// A formula as it is read: what is applied to what, each part with its place in the text.
struct FormulaTree {
  enum class Kind { kNumber, kName, kCall, kSum, kDifference, kProduct, kQuotient, kPower, kMinus };
  Kind kind = Kind::kNumber;
  double number = 0.0;                 // kNumber
  std::string name;                    // kName, kCall
  std::vector<FormulaTree> arguments;  // of all but kNumber and kName
  std::size_t begin = 0, end = 0;      // bytes of the text
  std::size_t at = 0;                  // of the operator
};

/// Most bytes of a formula, and how deep its parentheses may be nested.
inline constexpr std::size_t kLongestFormula = 600;
inline constexpr int kDeepestFormula = 24;

/// Reads numbers, names, + - * / ^, calls and parentheses; -x^2 is -(x^2), x^y^z is x^(y^z).
/// Throws FormulaError with the place.
FormulaTree ParseFormula(std::string_view text);

}  // namespace hoplab
