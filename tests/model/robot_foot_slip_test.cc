#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_energy.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// Feet of a robot that creep over the ground under a force along it, M29.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// What creeps takes c F_x^2 from an undamped robot, by Simpson's rule over every millisecond
// without an event.
TEST(RobotFootSlip, TakesTheSquareOfTheForce) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->control = MotorControl::kLocked;
  p.robot->foot_slip = 2e-4;
  double worst = 0.0, most = 0.0;
  int intervals = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SimulationRequest q = RandomRobotDrop(p, seed, 0.4);
    const EnergyRun at = RunWithEnergy(q);
    constexpr int kParts = 8;  // of a millisecond
    std::vector<double> rows;
    for (const double t : at.times)
      for (int k = 0; k < kParts; ++k) rows.push_back(t + 1e-3 * k / kParts);
    const std::array channels = {Channel::kLegForceX1, Channel::kLegForceX2};
    q.row_times = rows;
    q.channels = channels;
    const Trajectory run = Simulate(q);
    const auto power = [&](std::size_t row) {
      double sum = 0.0;
      for (std::size_t k = 0; k < channels.size(); ++k) {
        const double force = run.samples[channels.size() * row + k];
        if (std::isfinite(force)) sum += p.robot->foot_slip * force * force;
      }
      return sum;
    };
    for (std::size_t i = 0; i + 1 < at.energy.size(); ++i) {
      bool clear = at.times[i + 1] < run.end_time;
      for (const Event& e : run.events)
        clear = clear && (e.time < at.times[i] || e.time > at.times[i + 1]);
      if (!clear) continue;
      double lost = 0.0;
      for (std::size_t k = 0; k <= kParts; ++k)
        lost += (k % kParts == 0 ? 1.0 : k % 2 == 0 ? 2.0 : 4.0) * power(kParts * i + k);
      lost *= 1e-3 / (3.0 * kParts);
      worst = std::max(worst, std::abs(at.energy[i] - at.energy[i + 1] - lost));
      most = std::max(most, lost);
      intervals += lost > 0.0;
    }
  }
  std::printf("  loses up to %.1e J a millisecond, off by %.1e\n", most, worst);
  EXPECT_GT(intervals, 200);
  EXPECT_GT(most, 1e-4);
  EXPECT_LT(worst, 1e-5 * most);
}

// From nothing on, and where it acts; feet with mass, that may slide, and without.
TEST(RobotFootSlip, HasTheDerivativesOfDifferences) {
  for (const double leg_mass : {0.0, 0.01}) {
    for (const double size : {0.0, 3e-4}) {
      Parameters<double> p = RobotParametersFor(2);
      p.robot->friction = 0.9;
      p.robot->damping = 3e-4;
      p.robot->leg_mass = leg_mass;
      p.robot->rotor_inertia = 4e-3;
      std::array effects = {EffectSetting::Null(*FindEffect("foot_slip"))};
      effects[0].values[0] = size;
      SimulationRequest q = RandomRobotDrop(p, 2, 0.2);
      q.effects = effects;
      q.integrator.relative_tolerance = kOracleRelative;
      // Errors of a leg's own rate count by what they move the leg (ErrorUnit).
      q.integrator.absolute_tolerance = 1e-2 * kOracleAbsolute;
      EXPECT_GE(ExpectRobotExact(q, {},
                                 {D::EffectParameter(0, 0), D::Parameter(ParameterId::kE),
                                  D::Parameter(ParameterId::kFriction), D::InitialState(2)}),
                10)
          << leg_mass << ", " << size;
    }
  }
}

}  // namespace
}  // namespace hoplab
