#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/laws/elastic_arc.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ConsistentLeg = CLeg<T, ConsistentLaw>;
template <class T>
using ConsistentBody = LeggedBody<T, ConsistentLeg>;
template <class T>
using LaggedConsistentBody = LeggedBody<T, ConsistentLeg, kLaggedLegStateSize>;

void RunConsistent(const SimulationRequest& request, Trajectory& out) {
  RunLeg<ConsistentBody, LaggedConsistentBody>(request, out);
}
double EnergyConsistent(const SimulationRequest& request, Mode mode,
                        std::span<const double> state) {
  return EnergyOn<ConsistentBody>(request, mode, state);
}

}  // namespace hoplab
