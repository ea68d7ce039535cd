#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/text.h"

namespace hoplab {

/// The shortest text that gives the number back; empty for NaN.
template <class Number>
std::string NumberText(Number value) {
  if constexpr (std::is_floating_point_v<Number>) {
    if (std::isnan(value)) return "";
    if constexpr (std::is_same_v<Number, double>) return FormatDouble(value);
  }
  char buffer[64];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

/// Numbers of a binary file as the text of a column: views of `block`, which is filled and must not
/// change afterwards. `next(i)` gives the i-th number.
template <class Next>
std::vector<std::string_view> TextOfNumbers(std::size_t count, const Next& next,
                                            std::string* block) {
  std::vector<std::size_t> ends;
  ends.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    *block += NumberText(next(i));
    ends.push_back(block->size());
  }
  std::vector<std::string_view> cells;
  cells.reserve(count);
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    cells.push_back(std::string_view(*block).substr(begin, end - begin));
    begin = end;
  }
  return cells;
}

}  // namespace hoplab
