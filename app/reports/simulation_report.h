#pragma once

#include <string>
#include <vector>

#include "model/simulate.h"

namespace hoplab {

/// Events and energies of a run, for a terminal.
std::string SimulationReport(const std::string& name, const SimulationRequest& request,
                             const Trajectory& run, bool colours);
/// Derivatives of its end by the directions of these names.
std::string SensitivityReport(const std::vector<std::string>& names, const Trajectory& run);

}  // namespace hoplab
