#pragma once

#include <string>
#include <vector>

namespace hoplab {

/// Warnings for a terminal: what is said of one file and then of others in the same words, numbers
/// aside, is said once, with how many more files it holds for. Order of first appearance.
std::vector<std::string> CollapseWarnings(const std::vector<std::string>& warnings);

}  // namespace hoplab
