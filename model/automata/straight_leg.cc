#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/mechanisms/straight_leg.h"

namespace hoplab {
void RunStraightLeg(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<StraightLeg>(request, out);
}
double EnergyStraightLeg(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  return EnergyOn<StraightLeg>(request, mode, state);
}

}  // namespace hoplab
