#pragma once

#include "fitting/problem.h"

namespace hoplab {

/// Whether a shared value lies on its bound, but for rounding.
inline bool IsOnLower(const SharedParameter& s, double value) {
  return value <= s.lower + 1e-9 * s.scale;
}
inline bool IsOnUpper(const SharedParameter& s, double value) {
  return value >= s.upper - 1e-9 * s.scale;
}

/// Whether the data leave a shared value where it is: it is held, or a fit has put it on a bound,
/// as near as a fit ends.
inline bool IsHeldOrOnBound(const SharedParameter& s, double value) {
  const double near = 1e-6 * s.scale;
  return s.held || value <= s.lower + near || value >= s.upper - near;
}

}  // namespace hoplab
