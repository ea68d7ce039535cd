#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/laws/half_circle.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ThesisLeg = CLeg<T, ThesisLaw>;
template <class T>
using ThesisBody = LeggedBody<T, ThesisLeg>;

void RunThesis(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<ThesisBody>(request, out);
}
double EnergyThesis(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  return EnergyOn<ThesisBody>(request, mode, state);
}

}  // namespace hoplab
