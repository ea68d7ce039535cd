#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "experiments/identification/identification.h"

namespace hoplab {

/// Keys of an identification in run.json.
void AddIdentification(const IdentificationRequest& request, const IdentificationResult& result,
                       Json& record);

/// readings.csv (every fit), front.csv, times.csv (readings of the convergence time), cells.csv
/// (every printed number with ours of the best beside it, and how much it pulls).
std::map<std::string, std::string> IdentificationTables(const IdentificationResult& result);

/// A fit as a scenario. `origin` is said in its comment: the command and the date.
std::string ScenarioText(const StudyFit& fit, const std::string& name, const std::string& origin);

/// "zero_force", "rest_length".
const char* WordOf(LiftoffRule rule);

}  // namespace hoplab
