#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace hoplab {

/// A physical unit as powers of metre, kilogram and second; an angle has none.
struct Unit {
  std::array<double, 3> power{};  // m, kg, s

  static Unit One() { return {}; }
  bool IsOne() const { return *this == Unit{}; }
  Unit ToThe(double exponent) const;
  friend Unit operator*(const Unit& a, const Unit& b);
  friend Unit operator/(const Unit& a, const Unit& b) { return a * b.ToThe(-1.0); }
  /// Powers are the same but for rounding.
  friend bool operator==(const Unit& a, const Unit& b);
};

/// Reads a unit as the catalogue writes them: "N s^2/m^2", "m/(N s)", "rad s/m", "1/s", "-". Of m,
/// kg, s, N, Pa, J, W, Hz, rad and 1, without prefixes; nothing for anything else.
std::optional<Unit> ParseUnit(std::string_view text);

/// As the catalogue writes it: "N s^2/m^2", "-" for a plain number.
std::string TextOf(const Unit& unit);

}  // namespace hoplab
