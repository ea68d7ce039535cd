#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/laws/half_circle.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using NoSlipLeg = CLeg<T, NoSlipLaw>;
template <class T>
using NoSlipBody = LeggedBody<T, NoSlipLeg>;
template <class T>
using LaggedNoSlipBody = LeggedBody<T, NoSlipLeg, kLaggedLegStateSize>;

void RunNoSlip(const SimulationRequest& request, Trajectory& out) {
  RunLeg<NoSlipBody, LaggedNoSlipBody>(request, out);
}
double EnergyNoSlip(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  return EnergyOn<NoSlipBody>(request, mode, state);
}

}  // namespace hoplab
