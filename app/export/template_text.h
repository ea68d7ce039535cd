#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace hoplab {

/// `text` with every `@NAME@` replaced by its value, and of the lines between `/*@if NAME*/`,
/// `/*@else*/` and `/*@end*/` those that count: the first where NAME is among `flags`, the others
/// where it is not. Not nested. A name without a value is a bug.
std::string FilledTemplate(std::string_view text, const std::map<std::string, std::string>& values,
                           const std::set<std::string>& flags);

}  // namespace hoplab
