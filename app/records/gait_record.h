#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "app/runs/gait_run.h"
#include "app/runs/gait_settings.h"

namespace hoplab {

/// run.json of a gait, `seconds` excepted.
Json GaitRecord(const GaitSettings& settings, const Scenario& scenario, const GaitRun& run);
/// The CSVs behind a gait's plots by file name: trajectory (the scenario's own run), cycles (the
/// steady hop), branch (where a parameter was followed).
std::map<std::string, std::string> GaitTables(const GaitRun& run);

}  // namespace hoplab
