#include "model/mechanisms/straight_leg.h"

#include "model/automata.h"
#include "model/hybrid/run.h"

namespace hoplab {
template <class T>
using StraightBody = LeggedBody<T, StraightSpring>;

void RunStraightLeg(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<StraightBody>(request, out);
}
double EnergyStraightLeg(const SimulationRequest& request, Mode mode,
                         std::span<const double> state) {
  return EnergyOn<StraightBody>(request, mode, state);
}

}  // namespace hoplab
