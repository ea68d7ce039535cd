#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/records/run_record.h"
#include "app/runs/sweep_settings.h"

namespace hoplab {

/// Rows of a sweep, in the order of the plan; absent ones were not computed.
using SweepRows = std::vector<std::optional<SweepRow>>;

/// Unit of a dotted key, by the suffix of its name; empty where it has none.
std::string UnitOfKey(const std::string& key);

/// run.json of a sweep without its rows.
Json NewSweepRecord(const SweepSettings& settings, const SweepPlan& plan);
/// Keys `columns` and `rows` of a sweep in run.json; rows that were not computed are left out.
void AddSweep(const SweepPlan& plan, const SweepRows& rows, Json& record);
/// The rows as CSV.
std::string SweepTable(const SweepPlan& plan, const SweepRows& rows);

}  // namespace hoplab
