#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/laws/half_circle.h"
#include "model/mechanisms/c_leg.h"
#include "model/mechanisms/toe_mass_body.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ToeMassThesisLeg = CLeg<T, ThesisLaw>;
template <class T>
using ToeMassThesisBody = ToeMassBody<T, ToeMassThesisLeg>;

void RunToeMassThesis(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<ToeMassThesisBody>(request, out);
}
double EnergyToeMassThesis(const SimulationRequest& request, Mode mode,
                           std::span<const double> state) {
  return EnergyOn<ToeMassThesisBody>(request, mode, state);
}

}  // namespace hoplab
