#pragma once

#include <string>

#include "app/run_record.h"
#include "experiments/identification/identification.h"

namespace hoplab {

/// Keys of an identification in run.json.
void AddIdentification(const IdentificationRequest& request, const IdentificationResult& result,
                       Json& record);

/// Every reading with its best constants: for table 6.5 alone, and for all tables.
std::string ReadingsTable(const IdentificationResult& result);
/// Every printed number with ours of the best reading beside it.
std::string NumbersTable(const StudyHopper& best, const StudyData& data);
/// The best reading as a scenario. `origin` is said in its comment: the command and the date.
std::string ScenarioText(const StudyHopper& best, const std::string& origin);

/// What the command prints.
std::string IdentifyReport(const IdentificationRequest& request, const IdentificationResult& result,
                           bool colours);

}  // namespace hoplab
