#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/laws/elastic_arc.h"
#include "model/mechanisms/c_leg.h"
#include "model/mechanisms/toe_mass_body.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ToeMassConsistentLeg = CLeg<T, ConsistentLaw>;
template <class T>
using ToeMassConsistentBody = ToeMassBody<T, ToeMassConsistentLeg>;

void RunToeMassConsistent(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<ToeMassConsistentBody>(request, out);
}
double EnergyToeMassConsistent(const SimulationRequest& request, Mode mode,
                               std::span<const double> state) {
  return EnergyOn<ToeMassConsistentBody>(request, mode, state);
}

}  // namespace hoplab
