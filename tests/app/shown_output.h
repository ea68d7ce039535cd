#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hoplab::testing {

/// The lines of a text, without the empty ones at its end.
std::vector<std::string> ShownLines(const std::string& text);

/// Whether two lines have the same words, and numbers that agree to the digits shown: within one
/// and a half units of the last digit.
bool SameLine(const std::string& shown, const std::string& printed);

/// Whether a command printed what a page shows; "..." on a line of its own stands for any lines.
::testing::AssertionResult PrintsAs(const std::vector<std::string>& shown,
                                    const std::vector<std::string>& printed);

}  // namespace hoplab::testing
