#include "bench/robot_second.h"

#include <array>

#include "base/check.h"
#include "tests/support/robot_gaits.h"

namespace hoplab::bench {
namespace {

std::span<const SensitivityDirection> RobotDirections(int count) {
  using D = SensitivityDirection;
  using P = ParameterId;
  static const std::array<D, 20> kAll = {D::Parameter(P::kE1),
                                         D::Parameter(P::kE2),
                                         D::Parameter(P::kLegDamping),
                                         D::Parameter(P::kLegMass),
                                         D::Parameter(P::kM),
                                         D::Parameter(P::kPitchInertia),
                                         D::Parameter(P::kComX),
                                         D::Parameter(P::kComY),
                                         D::Parameter(P::kRotorInertia),
                                         D::Parameter(P::kMotorKp),
                                         D::Parameter(P::kMotorKd),
                                         D::Parameter(P::kFriction),
                                         D::Parameter(P::kClockPeriod),
                                         D::Parameter(P::kClockDuty),
                                         D::InitialState(0),
                                         D::InitialState(1),
                                         D::InitialState(2),
                                         D::InitialState(3),
                                         D::InitialState(4),
                                         D::InitialState(5)};
  HOPLAB_CHECK(count >= 0 && count <= static_cast<int>(kAll.size()));
  return std::span(kAll).first(static_cast<std::size_t>(count));
}

}  // namespace

SimulationRequest RobotSecond(int directions, double leg_mass_kg) {
  SimulationRequest request = testing::PronkingRobot().request;
  request.parameters.robot->leg_mass = leg_mass_kg;
  request.parameters.robot->own_moduli = true;
  request.parameters.robot->E.fill(request.parameters.E);
  request.integrator = {};
  request.horizon = 1.0;
  request.directions = RobotDirections(directions);
  return request;
}

}  // namespace hoplab::bench
