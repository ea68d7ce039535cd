#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/laws/elastic_arc.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using LargeDeflectionLeg = CLeg<T, LargeDeflectionLaw>;
template <class T>
using LargeDeflectionBody = LeggedBody<T, LargeDeflectionLeg>;
template <class T>
using LaggedLargeDeflectionBody = LeggedBody<T, LargeDeflectionLeg, kLaggedLegStateSize>;

void RunLargeDeflection(const SimulationRequest& request, Trajectory& out) {
  RunLeg<LargeDeflectionBody, LaggedLargeDeflectionBody>(request, out);
}
double EnergyLargeDeflection(const SimulationRequest& request, Mode mode,
                             std::span<const double> state) {
  return EnergyOn<LargeDeflectionBody>(request, mode, state);
}

}  // namespace hoplab
