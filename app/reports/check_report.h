#pragma once

#include <string>

#include "app/runs/check_run.h"

namespace hoplab {

/// What a check found, for a terminal.
std::string CheckRunReport(const Dataset& dataset, const CheckRun& run, bool colours);

}  // namespace hoplab
