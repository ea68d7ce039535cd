#pragma once

#include "app/fit_run.h"
#include "app/run_record.h"

namespace hoplab {

/// run.json of a fit, `seconds` excepted. SI units, radians; what was not computed is null.
Json FitRecord(const Dataset& dataset, const std::string& dataset_argument,
               const FitRunOptions& options, const FitRun& run);

}  // namespace hoplab
