#pragma once

#include <map>
#include <string>

#include "app/runs/fit_run.h"

namespace hoplab {

/// The CSVs behind a fit's plots by file name: residuals, hops, events, trajectories, and profile
/// if one was asked for. Times are those of the dataset's own files. Empty if there is no result.
std::map<std::string, std::string> FitTables(const FitRun& run);

}  // namespace hoplab
