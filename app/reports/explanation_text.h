#pragma once

#include <string>
#include <vector>

#include "app/reports/explain.h"

namespace hoplab {

/// An explanation in two paragraphs, for a terminal of so many columns.
std::string ExplanationText(const Explanation& e, bool colours, std::size_t columns);

/// All that can be explained: laws, effects, words.
std::string ExplanationList(bool colours, std::size_t columns);

/// What `hoplab explain --json` prints.
Json ExplainRecord(const std::vector<Explanation>& explanations);

}  // namespace hoplab
