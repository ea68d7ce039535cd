#pragma once

#include <limits>

namespace hoplab {

/// Stands for a number that there is not.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace hoplab
