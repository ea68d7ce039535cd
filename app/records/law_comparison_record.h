#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "experiments/law_comparison.h"

namespace hoplab {

/// What `hoplab compare --json` prints; `dataset` is its name.
Json LawComparisonRecord(const std::string& dataset, const LawComparison& comparison,
                         const std::map<std::string, double>& truth);

}  // namespace hoplab
