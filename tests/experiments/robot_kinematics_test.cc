#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "base/units.h"
#include "experiments/kinematics/two_legs.h"
#include "tests/support/robot_requests.h"

// The two-legged kinematics of thesis ch. 3 (M18-M22) as the rigid limit of the robot (M72-M81):
// two stiff legs, turned slowly by their motors, roll as the half circles of chapter 3 do.

namespace hoplab {
namespace {

using namespace testing;

constexpr double kRear = 0.9, kFront = 0.6;  // motor angles at the start [rad]

// M18: the virtual link of a leg at beta stands at pi/2 - beta/2.
double LinkAngle(double beta) { return 0.5 * (kPi - beta); }

Parameters<double> StiffRobot(double E) {
  Parameters<double> p = RobotParametersFor(2);
  p.E = E;
  RobotParameters<double>& robot = *p.robot;
  robot.damping = 4e-4;
  robot.control = MotorControl::kClock;
  robot.period = 6.0;
  robot.duty = 0.6;
  robot.sweep = 1.2;
  robot.offset = kRear - 0.5 * robot.sweep;
  // The front motor is ahead by the difference of the angles.
  robot.phase = {0.0, robot.duty * (kRear - kFront) / robot.sweep, 0.0, 0.0};
  return p;
}

// Pitch at which both unloaded legs touch the ground, by Newton's method on M19.
double StartPitch(const Parameters<double>& p, double hip_distance) {
  double pitch = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double gap = hip_distance * std::sin(pitch) + p.r * std::cos(kRear + pitch) -
                       p.r * std::cos(kFront + pitch);
    const double slope = hip_distance * std::cos(pitch) - p.r * std::sin(kRear + pitch) +
                         p.r * std::sin(kFront + pitch);
    pitch -= gap / slope;
  }
  return pitch;
}

struct Gap {
  double pitch = 0.0, front = 0.0, height = 0.0, way = 0.0;
};

// How far the robot is from chapter 3 at the end of a second of rolling.
Gap AfterRolling(double E, double seconds) {
  const Parameters<double> p = StiffRobot(E);
  const double b = p.robot->hip_x[1] - p.robot->hip_x[0], d = 2.0 * p.r;
  const double pitch = StartPitch(p, b);
  const double rear_height = p.r * (1.0 + std::cos(kRear + pitch));
  // Pressed down by about what it weighs: it stands from the start (M79).
  const double sag = 5e-6 * 1e14 / E;
  const double y = rear_height - p.robot->hip_x[0] * std::sin(pitch) - sag;
  SimulationRequest q = RobotDrop(p, {0.0, y, 0.0, 0.0, pitch, 0.0}, seconds);
  q.integrator.relative_tolerance = 1e-9;
  q.integrator.absolute_tolerance = 1e-10;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(NameOf(run.outcome), NameOf(Outcome::kCompleted)) << run.end_time;
  const std::vector<double>& z = run.final_state;
  const double rear = LinkAngle(z[4] + z[6]), front = LinkAngle(z[4] + z[7]);

  TwoLegs legs;
  legs.hip_distance = b;
  legs.leg_diameter = d;
  const RollingPair pair(legs, {LinkAngle(kRear + pitch), LinkAngle(kFront + pitch)});
  EXPECT_NEAR(pair.start().pose.pitch, pitch, 1e-12);
  const PoseResult there = pair.At(rear);
  EXPECT_EQ(there.outcome, PoseOutcome::kReached);
  EXPECT_GT(std::abs(there.pose.pitch - pitch), 0.02);  // it has pitched on its way
  // The rear hip: its height by M18, its way by the arc laid down less what it moved over the foot.
  const auto ahead = [&](double link) { return 0.5 * d * std::sin(2.0 * link); };
  const double start = LinkAngle(kRear + pitch);
  const double way = d * (rear - start) - (ahead(rear) - ahead(start));
  const double hip_way = z[0] + p.robot->hip_x[0] * (std::cos(z[4]) - std::cos(pitch));
  const double hip_height = z[1] + p.robot->hip_x[0] * std::sin(z[4]);
  return {z[4] - there.pose.pitch, front - there.pose.psi_front,
          hip_height - d * std::sin(rear) * std::sin(rear), hip_way - way};
}

TEST(RobotKinematics, StiffLegsRollAsInChapterThree) {
  for (const double seconds : {0.6, 1.2}) {
    const Gap gap = AfterRolling(1e14, seconds);
    std::printf(
        "  after %.1f s: pitch %.1e rad, front leg %.1e rad, rear hip %.1e m up, %.1e m on\n",
        seconds, gap.pitch, gap.front, gap.height, gap.way);
    EXPECT_NEAR(gap.pitch, 0.0, 1e-4);
    EXPECT_NEAR(gap.front, 0.0, 1e-4);
    EXPECT_NEAR(gap.height, 0.0, 1e-5);
    EXPECT_NEAR(gap.way, 0.0, 1e-5);
  }
  // What is left is the legs' bending: four times less at four times the modulus.
  const Gap soft = AfterRolling(1e14, 1.2), stiff = AfterRolling(4e14, 1.2);
  EXPECT_NEAR(soft.height / stiff.height, 4.0, 1.0);
}

}  // namespace
}  // namespace hoplab
