#include "base/range.h"

#include <cmath>

#include "base/text.h"

namespace hoplab {

bool Range::Contains(double value) const {
  if (!std::isfinite(value)) return false;
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

std::string Range::Text() const {
  if (!std::isfinite(low) && !std::isfinite(high)) return "any finite number";
  std::string text = low_open ? "(" : "[";
  text += FormatDouble(low) + ", " + FormatDouble(high);
  text += high_open ? ")" : "]";
  if (*unit != '\0') text += std::string(" ") + unit;
  return text;
}

std::string RangeRemedy(double value, const Range& range) {
  if (!std::isfinite(value)) return "Write a finite number.";
  if (value < 0 && range.low >= 0) return "Check the sign.";
  return *range.unit != '\0' ? std::string("Check the unit: ") + range.unit + " is meant."
                             : std::string("Check the value.");
}

}  // namespace hoplab
