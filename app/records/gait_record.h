#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "app/runs/gait_run.h"

namespace hoplab {

/// Keys of a gait in run.json.
void AddGait(const GaitRun& run, Json& record);
/// The CSVs behind a gait's plots by file name: trajectory (the scenario's own run), cycles (the
/// steady hop), branch (where a parameter was followed).
std::map<std::string, std::string> GaitTables(const GaitRun& run);

}  // namespace hoplab
