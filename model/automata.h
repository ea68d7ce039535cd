#pragma once

#include <span>

#include "model/simulate.h"

namespace hoplab {

// One compiled automaton per law (model/automata/*.cc); `Simulate` chooses.
void RunThesis(const SimulationRequest& request, Trajectory& out);
void RunNoSlip(const SimulationRequest& request, Trajectory& out);
void RunConsistent(const SimulationRequest& request, Trajectory& out);
void RunLargeDeflection(const SimulationRequest& request, Trajectory& out);
void RunStraightLeg(const SimulationRequest& request, Trajectory& out);
void RunBall(const SimulationRequest& request, Trajectory& out);

double EnergyThesis(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyNoSlip(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyConsistent(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyLargeDeflection(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyStraightLeg(const SimulationRequest&, Mode, std::span<const double> state);
double EnergyBall(const SimulationRequest&, Mode, std::span<const double> state);

}  // namespace hoplab
