#pragma once

#include "app/records/run_record.h"
#include "app/runs/check_run.h"

namespace hoplab {

/// run.json of a check, `seconds` excepted.
Json CheckRecord(const Dataset& dataset, const CheckSettings& settings, const CheckRun& run);

}  // namespace hoplab
