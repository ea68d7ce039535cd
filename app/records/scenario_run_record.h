#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "app/runs/simulate_settings.h"

namespace hoplab {

/// Nothing was simulated that could be looked at.
bool IsUseless(Outcome outcome);

/// run.json of a simulated scenario, `seconds` excepted.
Json ScenarioRunRecord(const SimulateSettings& settings, const Scenario& scenario,
                       const SimulationRequest& request, const Trajectory& run);

/// trajectory.csv and events.csv.
std::map<std::string, std::string> ScenarioRunTables(const SimulationRequest& request,
                                                     const Trajectory& run);

}  // namespace hoplab
