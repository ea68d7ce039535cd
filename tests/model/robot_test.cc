#include "model/mechanisms/robot.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "model/effects/effect.h"
#include "model/simulate.h"
#include "tests/support/gradient_check.h"
#include "tests/support/robot_energy.h"
#include "tests/support/robot_requests.h"

// A robot on clamped arcs, M72-M76.

namespace hoplab {
namespace {

using namespace testing;

// What a lift-off leaves in a leg is lost where the foot is held to the last (M70); elsewhere the
// energy stays.
TEST(Robot, KeepsItsEnergyBetweenLiftOffs) {
  std::map<std::string, int> outcomes;
  double worst = 0.0;
  int steps = 0;
  for (int legs : {2, 3}) {
    for (MotorControl control : {MotorControl::kLocked, MotorControl::kHeld}) {
      for (unsigned seed = 1; seed <= 10; ++seed) {
        Parameters<double> p = RobotParametersFor(legs);
        p.robot->control = control;
        p.robot->motor_kd = 0.0;
        const EnergyRun at = RunWithEnergy(RandomRobotDrop(p, seed, 2.0));
        ++outcomes[std::string(NameOf(at.run.outcome))];
        std::size_t next = 0;
        for (std::size_t i = 1; i < at.energy.size(); ++i) {
          bool lifts = false;
          for (; next < at.run.events.size() && at.run.events[next].time < at.times[i]; ++next)
            lifts = lifts || at.run.events[next].kind == EventKind::kLiftoff;
          const double change = at.energy[i] - at.energy[i - 1];
          if (lifts) {
            EXPECT_LT(change, 1e-9);
            continue;
          }
          worst = std::max(worst, std::abs(change));
          ++steps;
        }
      }
    }
  }
  for (const auto& [name, count] : outcomes) std::printf("%s %d  ", name.c_str(), count);
  std::printf("\nenergy, worst change in 1 ms without a lift-off: %.1e J of 7, %d ms\n", worst,
              steps);
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(steps, 5000);
}

// On ice a leg holds nothing when it leaves: the energy stays over every event.
TEST(Robot, KeepsItsEnergyOnIce) {
  std::map<std::string, int> outcomes;
  double worst = 0.0;
  int events = 0;
  for (int legs : {2, 3}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Parameters<double> p = RobotParametersFor(legs);
      p.robot->control = MotorControl::kLocked;
      p.robot->friction = 0.0;
      p.robot->clamp = legs == 3 ? 0.006 : 0.0;
      const EnergyRun at = RunWithEnergy(RandomRobotDrop(p, seed, 2.0));
      ++outcomes[std::string(NameOf(at.run.outcome))];
      for (double e : at.energy) worst = std::max(worst, std::abs(e - at.energy.front()));
      events += static_cast<int>(at.run.events.size());
    }
  }
  for (const auto& [name, count] : outcomes) std::printf("%s %d  ", name.c_str(), count);
  std::printf("\nenergy on ice, worst drift: %.1e J of 7 over %d events\n", worst, events);
  EXPECT_LT(worst, 7e-9);
  EXPECT_GT(events, 100);
}

// ---- limits ----------------------------------------------------------------------------------

// Two legs side by side in phase, on a body that cannot pitch, are one leg of twice the modulus.
TEST(Robot, TwoLegsInPhaseAreOneOfTwiceTheModulus) {
  Parameters<double> two = RobotParametersFor(2), one = RobotParametersFor(1);
  two.robot->pitch_inertia = one.robot->pitch_inertia = 1e14;
  two.robot->damping = one.robot->damping = 4e-4;
  two.robot->friction = one.robot->friction = 0.9;
  // One motor for two: it has twice the rotor and the gains.
  one.E *= 2.0;
  one.robot->rotor_inertia *= 2.0;
  one.robot->motor_kp *= 2.0;
  one.robot->motor_kd *= 2.0;
  const auto run = [](const Parameters<double>& p) {
    return Simulate(RobotDrop(p, {0.0, 0.25, 0.3, 0.0, 0.0, 0.0}, 0.6));
  };
  const Trajectory a = run(two), b = run(one);
  ASSERT_EQ(a.outcome, b.outcome);
  EXPECT_TRUE(a.has_simultaneous_events);
  EXPECT_GT(b.events.size(), 3u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(a.final_state[i], b.final_state[i], 1e-9) << i;
}

// Undamped, on ice, with locked motors a motion backward in time is one forward.
TEST(Robot, RunsBackwardAsForward) {
  int compared = 0;
  for (unsigned seed = 1; seed <= 12 && compared < 4; ++seed) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->control = MotorControl::kLocked;
    p.robot->friction = 0.0;
    SimulationRequest q = RandomRobotDrop(p, seed, 2.0);
    const Trajectory whole = Simulate(q);
    // To a moment in the second flight.
    double end = 0.0;
    for (std::size_t i = 1; i < whole.segments.size(); ++i)
      if (whole.segments[i].mode == Mode::kFlight && end == 0.0)
        end = 0.5 * (whole.segments[i].begin + whole.segments[i].end);
    if (end == 0.0) continue;
    q.horizon = end;
    const Trajectory there = Simulate(q);
    if (there.outcome != Outcome::kCompleted) continue;
    SimulationRequest back = q;
    back.initial.assign(there.final_state.begin(), there.final_state.begin() + 6);
    for (int i : {2, 3, 5}) back.initial[i] = -back.initial[i];
    const Trajectory again = Simulate(back);
    ASSERT_EQ(again.outcome, Outcome::kCompleted) << seed;
    for (int i : {0, 1, 4}) EXPECT_NEAR(again.final_state[i], q.initial[i], 1e-7) << seed;
    for (int i : {2, 3, 5}) EXPECT_NEAR(again.final_state[i], -q.initial[i], 1e-6) << seed;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

// A body that turns in the air about a centre of mass beside the reference point.
TEST(Robot, FliesAboutItsCentreOfMass) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->control = MotorControl::kLocked;
  p.robot->com_x = 0.03;
  p.robot->com_y = -0.01;
  const double pitch = 0.1, rate = 2.0, t = 0.15;
  const Trajectory run = Simulate(RobotDrop(p, {0.0, 1.0, 0.4, 1.0, pitch, rate}, t));
  const auto offset = [&](double angle) {
    return std::array{0.03 * std::cos(angle) + 0.01 * std::sin(angle),
                      0.03 * std::sin(angle) - 0.01 * std::cos(angle)};
  };
  const auto before = offset(pitch), after = offset(pitch + rate * t);
  // The centre of mass flies on a parabola.
  const double vx = 0.4 - rate * before[1], vy = 1.0 + rate * before[0];
  EXPECT_NEAR(run.final_state[0], before[0] + vx * t - after[0], 1e-10);
  EXPECT_NEAR(run.final_state[1], 1.0 + before[1] + vy * t - 0.5 * 9.81 * t * t - after[1], 1e-10);
  EXPECT_NEAR(run.final_state[4], pitch + rate * t, 1e-12);
}

// ---- clock, limits, outcomes -----------------------------------------------------------------

TEST(Robot, ClockTurnsTheReferenceByWholeTurns) {
  Parameters<double> p = RobotParametersFor(2);
  RobotParameters<double>& robot = *p.robot;
  robot.period = 0.4;
  robot.duty = 0.6;
  robot.sweep = 0.8;
  robot.offset = 0.2;
  robot.phase = {0.0, 0.5};
  const MotorClock<double> clock(robot, 1, 0.0);
  double last = clock.Angle(clock.PieceAt(0.0), 0.0);
  for (double t = 1e-3; t < 2.0; t += 1e-3) {
    const int piece = clock.PieceAt(t);
    const double angle = clock.Angle(piece, t);
    EXPECT_NEAR(angle - last, 0.0, 0.04) << t;  // continuous, also over the turns
    EXPECT_LE(t, clock.End(piece));
    last = angle;
  }
  // One period is one turn backward; the slow part sweeps its angle about the offset.
  const auto at = [&](double t) { return clock.Angle(clock.PieceAt(t), t); };
  EXPECT_NEAR(at(0.71) - at(0.31), -2.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(at(0.2) - at(0.2 + 0.6 * 0.4), 0.8, 1e-12);
  EXPECT_NEAR(at(0.2 + 0.3 * 0.4), 0.2 - 2.0 * std::numbers::pi, 1e-12);
}

TEST(Robot, ClockAndTorqueLimitLeaveTheirTraceInTheTorques) {
  SimulationRequest q = RobotDrop(Walking(), {0.0, 0.2, 0.4, 0.0, 0.0, 0.0}, 0.8);
  std::vector<double> rows;
  for (int i = 1; i < 800; ++i) rows.push_back(1e-3 * i);
  const std::array channels = {Channel::kHipTorque1, Channel::kHipTorque2, Channel::kLegAngle2};
  q.row_times = rows;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  int limits = 0;
  for (const Event& e : run.events) limits += e.kind == EventKind::kTorqueLimit;
  double most = 0.0;
  for (std::size_t i = 0; i + 2 < run.samples.size(); i += 3)
    if (!std::isnan(run.samples[i])) most = std::max(most, std::abs(run.samples[i]));
  EXPECT_LE(most, 6.0 + 1e-12);
  EXPECT_GT(limits, 2);
}

// Legs that swing in phase leave the limits of their motors at one instant, and feet that come to
// hold are at the edge of their cones: whatever integrates and whatever rows are read, the run is
// one.
TEST(Robot, LegsInPhaseAreAsAnotherIntegratorHasThem) {
  Parameters<double> p = RobotParametersFor(4);
  p.m = 5.0;
  RobotParameters<double>& robot = *p.robot;
  robot.pitch_inertia = 0.12;
  robot.hip_x = {-0.2, -0.07, 0.07, 0.2};
  robot.control = MotorControl::kClock;
  robot.period = 0.5;
  robot.duty = 0.7;
  robot.sweep = 0.7;
  robot.offset = 0.3;
  robot.phase = {0.0, 0.5, 0.0, 0.5};
  robot.torque_limit = 15.0;
  robot.friction = 0.9;
  robot.damping = 4e-4;
  std::vector<double> times;
  for (int i = 0; i <= 300; ++i) times.push_back(2e-3 * i);
  const std::array channels = {Channel::kBodyY};
  std::map<std::string, int> events;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    const auto about = [&](double mean, double most) {
      return std::uniform_real_distribution<double>(mean - most, mean + most)(random);
    };
    SimulationRequest q = RobotDrop(p,
                                    {0.0, about(0.206, 0.015), about(0.5, 0.2), about(0.0, 0.2),
                                     about(0.0, 0.03), about(0.0, 0.5)},
                                    0.6);
    q.integrator = {};
    const Trajectory run = Simulate(q);
    q.integrator = {IntegratorKind::kErkStep, 1e-12, 1e-13};
    q.row_times = times;
    q.channels = channels;
    const Trajectory other = Simulate(q);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << seed;
    ASSERT_EQ(other.outcome, Outcome::kCompleted) << seed;
    for (const Event& e : run.events) ++events[std::string(NameOf(e.kind))];
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(run.final_state[i], other.final_state[i], 1e-6) << seed << ", " << i;
  }
  EXPECT_GT(events["torque_limit"], 100);
  EXPECT_GT(events["stick"], 20);
}

TEST(Robot, FallsByName) {
  const auto outcome = [](Parameters<double> p, std::vector<double> start) {
    return Simulate(RobotDrop(p, std::move(start), 3.0)).outcome;
  };
  Parameters<double> p = RobotParametersFor(2);
  p.robot->friction = 1.0;
  EXPECT_EQ(outcome(p, {0.0, 0.6, 0.0, 0.0, 0.0, 6.0}), Outcome::kFellPitch);
  EXPECT_EQ(outcome(p, {0.0, 0.05, 0.0, 0.0, 0.0, 0.0}), Outcome::kStartsInGround);
  // Folded away the legs reach nothing: the hips come down.
  p.robot->angle = {-2.8, -2.8};
  EXPECT_EQ(outcome(p, {0.0, 0.3, 0.0, 0.0, 0.0, 0.0}), Outcome::kFellHeight);
}

// One that is beyond its limits where it begins does not go on.
TEST(Robot, WhatBeginsFallenEndsAtOnce) {
  Parameters<double> p = RobotParametersFor(2);
  const Trajectory pitched =
      Simulate(RobotDrop(p, {0.0, 0.6, 0.0, 0.0, p.robot->pitch_limit + 0.1, 0.0}, 3.0));
  EXPECT_EQ(pitched.outcome, Outcome::kFellPitch);
  EXPECT_EQ(pitched.end_time, 0.0);
  p.robot->angle = {-2.8, -2.8};
  p.fall_height = 0.4;
  const Trajectory low = Simulate(RobotDrop(p, {0.0, 0.3, 0.0, 0.0, 0.0, 0.0}, 3.0));
  EXPECT_EQ(low.outcome, Outcome::kFellHeight);
  EXPECT_EQ(low.end_time, 0.0);
  // Within them it falls as it did.
  p.fall_height = 0.2;
  EXPECT_GT(Simulate(RobotDrop(p, {0.0, 0.3, 0.0, 0.0, 0.0, 0.0}, 3.0)).end_time, 0.1);
}

// A run that begins with a leg on the ground goes on from one that begins a moment above it.
TEST(Robot, BeginsOnItsFeet) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->friction = 1.0;
  p.robot->damping = 3e-4;
  p.robot->angle = {0.4, 0.5};
  // Reach of the leg at 0.4 rad below its hip, M74.
  const double lands = p.r * (1.0 + std::cos(0.4));
  const auto run = [&](double height) {
    return Simulate(RobotDrop(p, {0.0, height, 0.1, -0.3, 0.0, 0.0}, 0.08));
  };
  const Trajectory above = run(lands + 1e-10), on = run(lands - 1e-10);
  EXPECT_EQ(on.segments.front().mode, Mode::kStance);
  ASSERT_EQ(above.final_state.size(), on.final_state.size());
  for (std::size_t i = 0; i < on.final_state.size(); ++i)
    EXPECT_NEAR(above.final_state[i], on.final_state[i], 1e-7) << i;
  // Deep in the ground it is pressed: both legs push the body up at once.
  SimulationRequest q = RobotDrop(p, {0.0, lands - 0.012, 0.1, 0.0, 0.02, 0.0}, 0.05);
  EXPECT_EQ(Simulate(q).outcome, Outcome::kCompleted);
  const std::vector<double> rows = {0.0, 0.002, 0.01, 0.03};
  const std::array channels = {Channel::kBodyY,    Channel::kBodyPitch,  Channel::kContact1,
                               Channel::kContact2, Channel::kLegForceY1, Channel::kLegForceY2};
  const std::vector<SensitivityDirection> directions = {
      SensitivityDirection::InitialState(1), SensitivityDirection::InitialState(4),
      SensitivityDirection::Parameter(ParameterId::kR),
      SensitivityDirection::Parameter(ParameterId::kE)};
  q.row_times = rows;
  q.channels = channels;
  const Trajectory seen = Simulate(q);
  for (const std::size_t i : {2, 3}) EXPECT_EQ(seen.samples[i], 1.0);
  for (const std::size_t i : {4, 5}) EXPECT_GT(seen.samples[i], 1.0);
  q.channels = std::span(channels).first(2);
  q.directions = directions;
  for (const ColumnCheck& check : CheckGradient(q)) EXPECT_EQ(Complaint(check), "");
}

}  // namespace
}  // namespace hoplab
