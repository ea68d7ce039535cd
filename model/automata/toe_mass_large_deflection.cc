#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/laws/elastic_arc.h"
#include "model/mechanisms/c_leg.h"
#include "model/mechanisms/toe_mass_body.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ToeMassLargeDeflectionLeg = CLeg<T, LargeDeflectionLaw>;
template <class T>
using ToeMassLargeDeflectionBody = ToeMassBody<T, ToeMassLargeDeflectionLeg>;

void RunToeMassLargeDeflection(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<ToeMassLargeDeflectionBody>(request, out);
}
double EnergyToeMassLargeDeflection(const SimulationRequest& request, Mode mode,
                                    std::span<const double> state) {
  return EnergyOn<ToeMassLargeDeflectionBody>(request, mode, state);
}

}  // namespace hoplab
