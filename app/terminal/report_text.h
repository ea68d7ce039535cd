#pragma once

#include <string>
#include <vector>

#include "app/terminal/console.h"

namespace hoplab {

/// "1 trial", "3 trials".
std::string Plural(long count, const std::string& noun);

/// `text` broken at blanks to lines of `width`; the first begins at column `begin` (what stands
/// before it is the caller's), the others are indented by `begin`. No newline at the end.
std::string Wrapped(const std::string& text, std::size_t begin, std::size_t width = kReportWidth);

/// "  label        text\n", wrapped under itself.
std::string Labelled(const std::string& label, const std::string& text, bool colours);

/// Lines of a table, the first of them faint.
std::string WithHeader(const std::vector<std::string>& lines, bool colours);

}  // namespace hoplab
