#pragma once

#include <string>

#include "app/runs/optimize_run.h"

namespace hoplab {

/// What the command prints.
std::string OptimizeReport(const std::string& name, const OptimizeRun& run, bool colours);

}  // namespace hoplab
