#pragma once

#include <optional>
#include <string>
#include <utility>

namespace hoplab {

/// A unit in which a value reads well: `shown = SI value * factor`.
struct ReadableUnit {
  double factor = 1.0;
  std::string unit;  // empty where there is none
};

/// 22e9 Pa -> GPa, 0.0004 m -> mm; SI prefixes for simple units only, `-` becomes empty.
ReadableUnit ReadableUnitOf(double value, const std::string& unit);

/// Decimals with which an uncertainty of `half_width` shows two significant digits; 0 to 12.
int DecimalsFor(double half_width);

/// `value` with so many decimals; "-" for NaN.
std::string Fixed(double value, int decimals);

/// The same with two significant digits at least, also where these decimals show fewer: a value
/// that is small beside its interval is not zero.
std::string FixedOrMore(double value, int decimals);

/// `value` with so many significant digits, never an exponent between 1e-4 and 1e6; "-" for NaN.
std::string Significant(double value, int digits);

/// A root-mean-square error for the terminal, lengths in mm: "0.53 mm".
std::string ErrorText(double value, const std::string& unit);

/// "body_x" of "body_x_m": a column's name without its unit.
std::string WithoutUnit(const std::string& channel);

/// Its unit: "m", "N m"; empty of a column without one.
std::string UnitOfChannel(const std::string& channel);

}  // namespace hoplab
