#pragma once

#include <limits>
#include <string>

namespace hoplab {

/// The values a number may take: an interval, each end open or closed, and the unit to state.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;
  const char* unit = "";  // "Pa"; empty for a pure number

  /// False for NaN and infinities, whatever the ends.
  bool Contains(double value) const;
  /// "(0, 1e13] Pa"; "any finite number" where neither end is finite.
  std::string Text() const;
};

inline constexpr Range kAnyNumber = {};
/// (0, high]: what a mass, a length, a stiffness must lie in.
constexpr Range Positive(double high, const char* unit) { return {0.0, high, true, false, unit}; }
/// [0, high].
constexpr Range NonNegative(double high, const char* unit) {
  return {0.0, high, false, false, unit};
}
/// [-size, size].
constexpr Range Within(double size, const char* unit) { return {-size, size, false, false, unit}; }

/// What to try first when `value` lies outside `range`: the sign, or the unit.
std::string RangeRemedy(double value, const Range& range);

}  // namespace hoplab
