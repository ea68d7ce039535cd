#pragma once

#include <vector>

#include "app/records/compared_side.h"

namespace hoplab {

/// Every value that one of the runs fitted, each run's beside the first's; `independent`: not of
/// the recordings of the first.
Json ValuesRecord(const std::vector<ComparedSide>& sides, const std::vector<bool>& independent);

/// What was set otherwise: law, options, and stated values that no run fitted.
Json ChangedRecord(const std::vector<ComparedSide>& sides);

}  // namespace hoplab
