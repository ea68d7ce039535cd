#pragma once

#include <string>

#include "app/records/sweep_record.h"

namespace hoplab {

/// What the command prints: how the runs ended, the first rows.
std::string SweepReport(const SweepPlan& plan, const SweepRows& rows, bool colours);

}  // namespace hoplab
