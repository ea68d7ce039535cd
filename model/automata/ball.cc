#include "model/mechanisms/ball.h"

#include "model/automata.h"
#include "model/hybrid/run.h"

namespace hoplab {
void RunBall(const SimulationRequest& request, Trajectory& out) {
  RunAutomaton<Ball>(request, out);
}
double EnergyBall(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  return EnergyOn<Ball>(request, mode, state);
}

}  // namespace hoplab
