#include "model/mechanisms/straight_leg.h"

#include "model/automata.h"
#include "model/hybrid/run.h"

namespace hoplab {
template <class T>
using StraightBody = LeggedBody<T, StraightSpring>;
template <class T>
using LaggedStraightBody = LeggedBody<T, StraightSpring, kLaggedLegStateSize>;

void RunStraightLeg(const SimulationRequest& request, Trajectory& out) {
  RunLeg<StraightBody, LaggedStraightBody>(request, out);
}
double EnergyStraightLeg(const SimulationRequest& request, Mode mode,
                         std::span<const double> state) {
  return EnergyOn<StraightBody>(request, mode, state);
}

}  // namespace hoplab
