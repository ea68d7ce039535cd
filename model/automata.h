#pragma once

#include <span>

#include "model/simulate.h"

namespace hoplab {

// One compiled automaton per law, and one more for a leg with a toe mass (model/automata/*.cc);
// `Simulate` chooses.
void RunThesis(const SimulationRequest& request, Trajectory& out);
void RunNoSlip(const SimulationRequest& request, Trajectory& out);
void RunConsistent(const SimulationRequest& request, Trajectory& out);
void RunLargeDeflection(const SimulationRequest& request, Trajectory& out);
void RunStraightLeg(const SimulationRequest& request, Trajectory& out);
void RunToeMassThesis(const SimulationRequest& request, Trajectory& out);
void RunToeMassNoSlip(const SimulationRequest& request, Trajectory& out);
void RunToeMassConsistent(const SimulationRequest& request, Trajectory& out);
void RunToeMassLargeDeflection(const SimulationRequest& request, Trajectory& out);
void RunToeMassStraightLeg(const SimulationRequest& request, Trajectory& out);
void RunBall(const SimulationRequest& request, Trajectory& out);

double EnergyThesis(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyNoSlip(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyConsistent(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyLargeDeflection(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyStraightLeg(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyToeMassThesis(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyToeMassNoSlip(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyToeMassConsistent(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyToeMassLargeDeflection(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyToeMassStraightLeg(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyBall(const SimulationRequest&, Mode, std::span<const double> state);

}  // namespace hoplab
