#include "model/simulate.h"

#include <limits>

#include "model/automata.h"

namespace hoplab {
namespace {

struct Automaton {
  void (*run)(const SimulationRequest&, Trajectory&);
  double (*energy)(const SimulationRequest&, Mode, std::span<const double>);
};

Automaton MasslessAutomatonOf(Law law) {
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

Automaton ToeMassAutomatonOf(Law law) {
  switch (law) {
    case Law::kThesis:
      return {RunToeMassThesis, EnergyToeMassThesis};
    case Law::kNoSlip:
      return {RunToeMassNoSlip, EnergyToeMassNoSlip};
    case Law::kConsistent:
      return {RunToeMassConsistent, EnergyToeMassConsistent};
    case Law::kLargeDeflection:
      return {RunToeMassLargeDeflection, EnergyToeMassLargeDeflection};
    case Law::kStraightLeg:
      return {RunToeMassStraightLeg, EnergyToeMassStraightLeg};
    case Law::kBall:
      break;
  }
  return MasslessAutomatonOf(law);
}

Automaton AutomatonOf(const SimulationRequest& request) {
  return request.parameters.m_toe > 0.0 ? ToeMassAutomatonOf(request.law)
                                        : MasslessAutomatonOf(request.law);
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
  AutomatonOf(request).run(request, out);
}

Trajectory Simulate(const SimulationRequest& request) {
  Trajectory out;
  Simulate(request, out);
  return out;
}

double Energy(const SimulationRequest& request, Mode mode, std::span<const double> state) {
  return AutomatonOf(request).energy(request, mode, state);
}

}  // namespace hoplab
