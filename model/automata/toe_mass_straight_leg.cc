#include "model/automata.h"
#include "model/hybrid/run.h"
#include "model/mechanisms/straight_leg.h"
#include "model/mechanisms/toe_mass_body.h"

namespace hoplab {
template <class T>
using ToeMassStraightLegBody = ToeMassBody<T, StraightSpring>;

void RunToeMassStraightLeg(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<ToeMassStraightLegBody>(request, out);
}
double EnergyToeMassStraightLeg(const SimulationRequest& request, Mode mode,
                                std::span<const double> state) {
  return EnergyOn<ToeMassStraightLegBody>(request, mode, state);
}

}  // namespace hoplab
