// Simulates a few hops of a half-circular leg and prints what happens when.
#include <cstdio>

#include "model/simulate.h"

int main() {
  hoplab::SimulationRequest request;
  request.law = hoplab::Law::kElastica;
  // Everything is in SI units and radians.
  auto& p = request.parameters;
  p.m = 1.0;          // body mass [kg]
  p.r = 0.09;         // radius of the leg [m]
  p.E = 22e9;         // Young's modulus [Pa]
  p.G = 4e9;          // shear modulus [Pa]
  p.I = 1.3718e-10;   // second moment of the strip's section [m^4]
  p.A = 1.14e-4;      // area of the section [m^2]
  p.d = 0.0;          // no damping: the energy must stay
  p.theta_td = 0.44;  // angle of the leg at touch-down [rad]
  // The hip at the start: x, y [m], vx, vy [m/s]. The leg is in the air.
  request.initial = {0.0, 0.30, 1.3, 0.0};
  request.horizon = 5.0;  // s
  request.max_hops = 2;

  const hoplab::Trajectory run = hoplab::Simulate(request);

  for (const hoplab::Event& e : run.events)
    std::printf("%7.4f s  %-14s x %.3f m  y %.3f m\n", e.time, NameOf(e.kind).data(), e.x, e.y);
  const double begin = hoplab::Energy(request, hoplab::Mode::kFlight, request.initial);
  const double end = hoplab::Energy(request, run.final_mode, run.final_state);
  std::printf("ended: %s\n", NameOf(run.outcome).data());
  std::printf("energy %.4f J before, %.4f J after\n", begin, end);
  return hoplab::IsComplete(run.outcome) ? 0 : 1;
}
