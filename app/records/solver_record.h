#pragma once

#include "app/records/run_record.h"
#include "app/runs/run_settings.h"

namespace hoplab {

/// What a record's options say of how motions were integrated.
void RecordSolver(const SolverSettings& settings, Json& options);

}  // namespace hoplab
