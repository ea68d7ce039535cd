#pragma once

#include <string>

#include "app/records/run_record.h"

namespace hoplab {

/// The record for a terminal.
std::string ComparisonReport(const Json& record, bool colours);

}  // namespace hoplab
