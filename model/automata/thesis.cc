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
template <class T>
using LaggedThesisBody = LeggedBody<T, ThesisLeg, kLaggedLegStateSize>;

void RunThesis(const SimulationRequest& request, Trajectory& out) {
  RunLeg<ThesisBody, LaggedThesisBody>(request, out);
}
double EnergyThesis(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  return EnergyOn<ThesisBody>(request, mode, state);
}

}  // namespace hoplab
