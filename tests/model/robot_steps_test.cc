// The steps of a robot's run: how far its motors let them be.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "model/simulate.h"
#include "tests/support/robot_requests.h"

namespace hoplab {
namespace {

using D = SensitivityDirection;

// Two legs turned by a clock; their motors forget a rate within 0.6 ms.
SimulationRequest QuickMotors(double tolerance, double horizon) {
  Parameters<double> p = testing::RobotParametersFor(2);
  RobotParameters<double>& robot = *p.robot;
  robot.control = MotorControl::kClock;
  robot.period = 0.40;
  robot.duty = 0.5624;
  robot.sweep = 1.25;
  robot.offset = 0.4181;
  robot.motor_kp = 47.35;
  robot.motor_kd = 1.662;
  robot.torque_limit = 15.0;
  robot.friction = 1.0;
  robot.damping = 4e-4;
  SimulationRequest q = testing::RobotDrop(p, {0.0, 0.222, 0.72, 0.0, 0.03, 0.0}, horizon);
  q.integrator = {.relative_tolerance = tolerance, .absolute_tolerance = 0.1 * tolerance};
  return q;
}

TEST(RobotSteps, AreTheSameWithDirections) {
  const std::vector<D> directions = {D::InitialState(2), D::Parameter(ParameterId::kMotorKd)};
  for (const double tolerance : {1e-7, 1e-9}) {
    SimulationRequest q = QuickMotors(tolerance, 0.3);
    const Trajectory plain = Simulate(q);
    q.directions = directions;
    const Trajectory with = Simulate(q);
    ASSERT_EQ(plain.outcome, Outcome::kCompleted);
    EXPECT_EQ(with.steps, plain.steps);
    for (std::size_t i = 0; i < plain.final_state.size(); ++i)
      EXPECT_NEAR(with.final_state[i], plain.final_state[i], 0.1 * tolerance) << i;
  }
}

// An error of a motor's rate counts by what it moves the motor: the state is as good as was asked
// for, with fewer steps (308 in 0.3 s where 1e-10 rad/s was asked of the rate itself). Its motors
// stay at rest, since steps are no longer than these let them be: without that 1e-7 is off by 8e-8.
TEST(RobotSteps, KeepTheTolerance) {
  for (const double horizon : {0.12, 0.2, 0.3}) {
    const Trajectory exact = Simulate(QuickMotors(1e-13, horizon));
    for (const double tolerance : {1e-7, 1e-9}) {
      const Trajectory run = Simulate(QuickMotors(tolerance, horizon));
      double off = 0.0;
      for (int i = 0; i < 8; ++i)
        off = std::max(off, std::abs(run.final_state[i] - exact.final_state[i]));
      std::printf("%.2f s at %.0e: %ld steps, off by %.1e\n", horizon, tolerance, run.steps, off);
      EXPECT_LT(off, 0.1 * tolerance) << horizon;
    }
  }
  EXPECT_LT(Simulate(QuickMotors(1e-9, 0.3)).steps, 260);
}

}  // namespace
}  // namespace hoplab
