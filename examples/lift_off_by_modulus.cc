// How much later does the leg lift off if its material is softer? The simulator gives the
// derivative of an event's time by a parameter; a difference of two more runs shows that it is
// right.
#include <cstdio>

#include "model/simulate.h"

namespace {

hoplab::SimulationRequest Hop(double modulus) {
  hoplab::SimulationRequest request;
  auto& p = request.parameters;
  p.r = 0.09;
  p.E = modulus;
  p.G = 4e9;
  p.I = 1.3718e-10;
  p.A = 1.14e-4;
  p.d = 3.0;
  p.theta_td = 0.44;
  request.initial = {0.0, 0.30, 1.3, 0.0};
  request.horizon = 5.0;
  request.max_hops = 1;
  return request;
}

// Place of the first lift-off among the events.
std::size_t LiftOff(const hoplab::Trajectory& run) {
  std::size_t i = 0;
  while (run.events.at(i).kind != hoplab::EventKind::kLiftoff) ++i;
  return i;
}

double LiftOffTime(double modulus) {
  const hoplab::Trajectory run = hoplab::Simulate(Hop(modulus));
  return run.events[LiftOff(run)].time;
}

}  // namespace

int main() {
  constexpr double modulus = 22e9, step = 22e5;
  const auto by_modulus = hoplab::SensitivityDirection::Parameter(hoplab::ParameterId::kE);
  hoplab::SimulationRequest request = Hop(modulus);
  request.directions = {&by_modulus, 1};
  const hoplab::Trajectory run = hoplab::Simulate(request);

  // One derivative for each event, since there is one direction.
  const double derivative = run.event_time_sensitivities[LiftOff(run)];
  const double difference =
      (LiftOffTime(modulus + step) - LiftOffTime(modulus - step)) / (2.0 * step);
  std::printf("lift-off at %.5f s\n", run.events[LiftOff(run)].time);
  std::printf("derivative  %.4f ms/GPa\n", derivative * 1e12);
  std::printf("difference  %.4f ms/GPa\n", difference * 1e12);
}
