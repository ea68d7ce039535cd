#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/records/stored_run.h"

namespace hoplab {

/// A run that is compared.
struct ComparedRun {
  std::filesystem::path folder;
  StoredRun run;
};

/// Fits and diagnoses side by side, each held against the first (fitting/README.md): values with
/// intervals, the difference with its interval and z, errors, causes, and what was set otherwise.
/// Of a diagnosis the values are those of the model with the causes it found. A difference of runs
/// on the same recordings has neither interval nor z: their errors are common. Throws InputError
/// (place: the run.json) for a run of another kind, or one without a result.
Json ComparisonRecord(const std::vector<ComparedRun>& runs);

/// Rows of values.csv: one a value and run.
std::string ComparisonTable(const Json& record);

}  // namespace hoplab
