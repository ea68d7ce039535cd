#pragma once

#include <span>
#include <string_view>

namespace hoplab {

/// A file of `experiments/published`, built into the program.
struct PublishedText {
  std::string_view name;  // without .csv
  std::string_view text;
};
std::span<const PublishedText> PublishedTexts();

}  // namespace hoplab
