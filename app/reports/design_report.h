#pragma once

#include <string>

#include "app/runs/design_run.h"

namespace hoplab {

/// The run for a terminal.
std::string DesignReport(const Dataset& dataset, const DesignRun& run, bool colours);

}  // namespace hoplab
