#pragma once

#include "app/records/run_record.h"
#include "app/runs/fit_run.h"

namespace hoplab {

/// run.json of a fit, `seconds` excepted. SI units, radians; what was not computed is null.
Json FitRecord(const Dataset& dataset, const std::string& dataset_argument,
               const FitRunOptions& options, const FitRun& run);

}  // namespace hoplab
