#pragma once

#include <map>
#include <string>

#include "experiments/law_comparison.h"

namespace hoplab {

/// A line a model, values beside what is known from elsewhere, for a terminal.
std::string LawComparisonReport(const LawComparison& comparison,
                                const std::map<std::string, double>& truth);

}  // namespace hoplab
