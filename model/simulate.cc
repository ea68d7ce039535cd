#include "model/simulate.h"

#include <limits>

#include "model/automata.h"

namespace hoplab {
namespace {

struct Automaton {
  void (*run)(const SimulationRequest&, Trajectory&);
  double (*energy)(const SimulationRequest&, Mode, std::span<const double>);
};

Automaton AutomatonOf(Law law) {
  switch (law) {
    case Law::kThesis:
      return {RunThesis, EnergyThesis};
    case Law::kNoSlip:
      return {RunNoSlip, EnergyNoSlip};
    case Law::kConsistent:
      return {RunConsistent, EnergyConsistent};
    case Law::kLargeDeflection:
      return {RunLargeDeflection, EnergyLargeDeflection};
    case Law::kStraightLeg:
      return {RunStraightLeg, EnergyStraightLeg};
    case Law::kBall:
      return {RunBall, EnergyBall};
  }
  return {};
}

}  // namespace

void Simulate(const SimulationRequest& request, Trajectory& out) {
  out.Clear();
  out.directions = static_cast<int>(request.directions.size());
  out.channels = static_cast<int>(request.channels.size());
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  const std::size_t cells = request.row_times.size() * request.channels.size();
  out.samples.assign(cells, kMissing);
  out.sensitivities.assign(cells * request.directions.size(), kMissing);
  AutomatonOf(request.law).run(request, out);
}

Trajectory Simulate(const SimulationRequest& request) {
  Trajectory out;
  Simulate(request, out);
  return out;
}

double Energy(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  return AutomatonOf(request.law).energy(request, mode, state);
}

}  // namespace hoplab
