#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/run_record.h"
#include "model/simulate.h"

namespace hoplab {

/// A direction `--sensitivities` names: x0, y0, vx0, vy0, a parameter of the mechanism or
/// effect.parameter of an effect that acts. Throws InputError with the nearest known name.
SensitivityDirection ResolveDirection(const std::string& name, MechanismKind mechanism,
                                      LegMass mass, const std::vector<EffectSetting>& effects);

/// Total energy at each apex [J], the start being the first of them: (time [s], energy).
std::vector<std::pair<double, double>> ApexEnergies(const SimulationRequest& request,
                                                    const Trajectory& run);

/// Keys of a simulation: outcome, end, events, final state, energies, derivatives.
void AddSimulation(const SimulationRequest& request, const Trajectory& run,
                   const std::vector<std::string>& direction_names, Json& record);

}  // namespace hoplab
