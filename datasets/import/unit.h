#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/channel.h"

namespace hoplab {

/// What a column of a log measures.
enum class Dimension { kTime, kLength, kVelocity, kAngle, kForce, kTorque, kAcceleration, kNone };

/// "a length".
const char* DimensionName(Dimension dimension);
Dimension DimensionOf(Channel channel);

/// A unit a log may be in: SI value = value * factor * 10^power_of_ten. Metric ones have the factor
/// 1, so that a change of unit is a shift of the decimal point.
struct LogUnit {
  std::string name;  // "mm"
  Dimension dimension = Dimension::kNone;
  int power_of_ten = 0;
  double factor = 1;
};

/// "mm", "Millimeters", "[mm]" without its brackets: letters of other case only where that leaves
/// no doubt (`Nm` is a torque, `nm` a length). Nothing for an unknown one.
std::optional<LogUnit> FindUnit(std::string_view text);
/// Names of the units of a dimension, SI first.
std::vector<std::string> UnitNames(Dimension dimension);

/// The number in SI units as decimal text: digit by digit where the factor is 1, else the shortest
/// text of the rounded product.
std::string ToSi(std::string_view number, const LogUnit& unit);

/// A column's title taken apart: "z [mm]", "Time (ms)", "pitch deg", "t / s", "body_y_m".
struct ColumnTitle {
  std::string stem;  // "z"
  std::string unit;  // "mm"; empty: none
};
ColumnTitle SplitTitle(std::string_view title);

}  // namespace hoplab
