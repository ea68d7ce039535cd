#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "app/runs/optimize_run.h"

namespace hoplab {

/// run.json of a search, `seconds` excepted.
Json OptimizeRecord(const OptimizeSettings& settings, const Scenario& scenario,
                    const OptimizeRun& run);
/// The tables of a run folder by file name.
std::map<std::string, std::string> OptimizeTables(const OptimizeRun& run);

}  // namespace hoplab
