#pragma once

#include <cstddef>

namespace hoplab {

/// Most steps of a formula: what stands on the stack while it is evaluated.
inline constexpr std::size_t kMostFormulaSteps = 96;

}  // namespace hoplab
