#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/records/run_record.h"
#include "model/simulate.h"

namespace hoplab {

/// Whether the run ended where it began: there is no end to be differentiated.
bool FailedAtOnce(const Trajectory& run);

/// Total energy at each apex [J], the start being the first of them: (time [s], energy).
std::vector<std::pair<double, double>> ApexEnergies(const SimulationRequest& request,
                                                    const Trajectory& run);

/// Keys of a simulation: outcome, end, events, final state, energies, derivatives.
void AddSimulation(const SimulationRequest& request, const Trajectory& run,
                   const std::vector<std::string>& direction_names, Json& record);

}  // namespace hoplab
