#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "app/runs/identify_settings.h"
#include "experiments/identification/fit_journal.h"

namespace hoplab {

/// run.json of an identification, `seconds` excepted.
Json IdentifyRecord(const IdentifySettings& settings, const IdentificationRequest& request,
                    const IdentificationResult& result);

/// The files of a run folder by name: `record`, tables, every fit of the journal, and the best
/// constants as scenarios.
std::map<std::string, std::string> IdentifyFiles(const IdentifySettings& settings,
                                                 const IdentificationResult& result,
                                                 const Json& record, const FitJournal& journal);

/// readings.csv (every fit), front.csv, times.csv (readings of the convergence time), cells.csv
/// (every printed number with ours of the best beside it, and how much it pulls).
std::map<std::string, std::string> IdentificationTables(const IdentificationResult& result);

/// A fit as a scenario. `origin` is said in its comment: the command and the date.
std::string ScenarioText(const StudyFit& fit, const std::string& name, const std::string& origin);

/// "zero_force", "rest_length".

}  // namespace hoplab
