#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/laws/half_circle.h"
#include "model/mechanisms/c_leg.h"
#include "model/mechanisms/toe_mass_body.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ToeMassNoSlipLeg = CLeg<T, NoSlipLaw>;
template <class T>
using ToeMassNoSlipBody = ToeMassBody<T, ToeMassNoSlipLeg>;

void RunToeMassNoSlip(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<ToeMassNoSlipBody>(request, out);
}
double EnergyToeMassNoSlip(const SimulationRequest& request, Mode mode,
                           std::span<const double> state) {
  return EnergyOn<ToeMassNoSlipBody>(request, mode, state);
}

}  // namespace hoplab
