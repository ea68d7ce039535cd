#pragma once

#include <string>

#include "app/runs/fit_run.h"

namespace hoplab {

/// What a fit found, for a terminal: one line a parameter, then what is weakly determined, errors
/// and the gradient certificate. Engineering units; the exact numbers are in run.json.
std::string FitReport(const Dataset& dataset, const FitRun& run, bool colours);

}  // namespace hoplab
