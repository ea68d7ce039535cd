#pragma once

#include "model/mechanisms/mechanism.h"
#include "model/simulate.h"

namespace hoplab {

/// Runs `request` on a mechanism; `out` is cleared and sized already.
void RunRequest(const SimulationRequest& request, const Mechanism& mechanism, Trajectory& out);

/// Energy [J] of a state, as Energy(request, mode, state) of simulate.h.
double EnergyOf(const SimulationRequest& request, const Mechanism& mechanism, Mode mode,
                std::span<const double> state);

}  // namespace hoplab
