#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "app/runs/reproduce_settings.h"

namespace hoplab {

/// Why there is only a part of what was asked for; empty if there is all of it.
std::string FailureOf(const Reproduction& reproduction);

/// run.json of a reproduction before its keys; `constants`: dotted.key=text, one a line.
Json NewReproductionRecord(const ReproduceSettings& settings, const Study& study,
                           const std::vector<std::string>& items, const std::string& constants);
/// Keys of a reproduction in run.json: tables, figures, claims, comparison, left_out. Angles in
/// rad, all else SI; the CSVs name their units in their headers.
void AddReproduction(const Reproduction& reproduction, Json& record);

/// The CSVs by file name: one for each table and figure and for a claim with a table behind it, and
/// every printed number beside ours in `comparison.csv`.
std::map<std::string, std::string> ReproductionTables(const Reproduction& reproduction);

}  // namespace hoplab
