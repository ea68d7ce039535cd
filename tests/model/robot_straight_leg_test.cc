#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "model/effects/effect.h"
#include "model/mechanisms/robot.h"
#include "model/simulate.h"
#include "tests/support/gradient_check.h"
#include "tests/support/robot_columns.h"
#include "tests/support/robot_energy.h"
#include "tests/support/robot_rods.h"

// A robot on straight legs, M97.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// ---- energy, symmetries ----------------------------------------------------------------------

// What a lift-off leaves in a leg is lost where the foot is held to the last (M70); elsewhere the
// energy stays. A mass of the legs changes nothing of that.
TEST(RobotOnRods, KeepsItsEnergyBetweenLiftOffs) {
  std::map<std::string, int> outcomes;
  double worst = 0.0;
  int steps = 0;
  for (int legs : {2, 3}) {
    for (MotorControl control : {MotorControl::kLocked, MotorControl::kHeld}) {
      for (unsigned seed = 1; seed <= 6; ++seed) {
        Parameters<double> p = RodParametersFor(legs);
        p.robot->control = control;
        p.robot->motor_kd = 0.0;
        if (seed % 2 == 0) p.robot->leg_mass = 0.03;
        const EnergyRun at = RunWithEnergy(RandomRodDrop(p, seed, 2.0));
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
  std::printf("\nenergy on rods, worst change in 1 ms without a lift-off: %.1e J of 7, %d ms\n",
              worst, steps);
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(steps, 3000);
}

// On ice a leg holds nothing when it leaves: the energy stays over every event.
TEST(RobotOnRods, KeepsItsEnergyOnIce) {
  double worst = 0.0;
  int events = 0;
  for (int legs : {2, 3}) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
      Parameters<double> p = RodParametersFor(legs);
      p.robot->control = MotorControl::kLocked;
      p.robot->friction = 0.0;
      const EnergyRun at = RunWithEnergy(RandomRodDrop(p, seed, 2.0));
      for (double e : at.energy) worst = std::max(worst, std::abs(e - at.energy.front()));
      events += static_cast<int>(at.run.events.size());
    }
  }
  std::printf("energy on rods on ice, worst drift: %.1e J of 7 over %d events\n", worst, events);
  EXPECT_LT(worst, 7e-9);
  EXPECT_GT(events, 100);
}

// Undamped, on ice, with locked motors a motion backward in time is one forward.
TEST(RobotOnRods, RunsBackwardAsForward) {
  int compared = 0;
  for (unsigned seed = 1; seed <= 16 && compared < 4; ++seed) {
    Parameters<double> p = RodParametersFor(2);
    p.robot->control = MotorControl::kLocked;
    p.robot->friction = 0.0;
    SimulationRequest q = RandomRodDrop(p, seed, 2.0);
    const Trajectory whole = Simulate(q);
    double end = 0.0;  // a moment in the second flight
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

// Unlike an arc a rod has no front: seen from the other side a run is one of the mirrored robot.
TEST(RobotOnRods, RunsTheSameSeenFromTheOtherSide) {
  int events = 0, slides = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Parameters<double> p = RodParametersFor(2);
    p.robot->friction = 0.3;
    p.robot->damping = 4e-4;
    p.robot->com_x = 0.01;
    if (seed % 2 == 0) p.robot->leg_mass = 0.02;
    const SimulationRequest q = RandomRodDrop(p, seed, 0.5);
    SimulationRequest mirrored = q;
    RobotParameters<double>& robot = *mirrored.parameters.robot;
    std::swap(robot.angle[0], robot.angle[1]);
    for (double& angle : robot.angle) angle = -angle;
    robot.com_x = -robot.com_x;
    for (int i : {0, 2, 4, 5}) mirrored.initial[i] = -mirrored.initial[i];
    const Trajectory a = Simulate(q), b = Simulate(mirrored);
    ASSERT_EQ(a.outcome, b.outcome) << seed;
    ASSERT_EQ(a.events.size(), b.events.size()) << seed;
    events += static_cast<int>(a.events.size());
    for (const Event& e : a.events) slides += e.kind == EventKind::kSlide;
    for (int i = 0; i < 6; ++i) {
      const double sign = i == 1 || i == 3 ? 1.0 : -1.0;
      EXPECT_NEAR(a.final_state[i], sign * b.final_state[i], 2e-7) << seed << " " << i;
    }
  }
  EXPECT_GT(events, 50);
  EXPECT_GT(slides, 3);
}

// ---- limits ----------------------------------------------------------------------------------

// One leg under the centre of mass, locked: where the body cannot pitch, two springs at right
// angles. Along and across the leg the hip swings about where its weight would hold it.
TEST(RobotOnRods, ALockedLegIsTwoSpringsAtRightAngles) {
  Parameters<double> p = RodParametersFor(1);
  p.robot->control = MotorControl::kLocked;
  p.robot->pitch_inertia = 1e14;
  const double beta = p.robot->angle[0] = 0.15, fall = 0.01, vx = 0.2, g = p.g;
  const double s = std::sin(beta), c = std::cos(beta);
  const double down = std::sqrt(2.0 * fall / g), vy = -std::sqrt(2.0 * g * fall), t = 0.03;
  const Trajectory run =
      Simulate(RobotDrop(p, {0.0, p.l0 * c + fall, vx, 0.0, 0.0, 0.0}, down + t));
  ASSERT_EQ(run.outcome, Outcome::kCompleted);
  ASSERT_EQ(run.events.size(), 1u);
  // d'' = -F/m - g, from d' = -v.
  const auto swing = [&](double stiffness, double pull, double rate) {
    const double w = std::sqrt(stiffness / p.m), middle = pull / (w * w);
    return middle * (1.0 - std::cos(w * t)) + rate / w * std::sin(w * t);
  };
  const double a = p.l0 + swing(p.k, -g * c, -vx * s + vy * c),
               b = swing(p.robot->lateral_stiffness, g * s, -vx * c - vy * s);
  const double foot = vx * down + p.l0 * s;
  EXPECT_NEAR(run.final_state[0], foot - a * s - b * c, 1e-10);
  EXPECT_NEAR(run.final_state[1], a * c - b * s, 1e-10);
}

// Locked legs that lean apart hop in place, hop by hop the same: a fixed point in closed form.
TEST(RobotOnRods, HopsInPlaceOnLegsThatLeanApart) {
  Parameters<double> p = RodParametersFor(2);
  p.robot->control = MotorControl::kLocked;
  const double beta = 0.2, fall = 0.03, g = p.g;
  p.robot->angle = {-beta, beta};
  const double s = std::sin(beta), c = std::cos(beta);
  const double stiffness = 2.0 * (p.k * c * c + p.robot->lateral_stiffness * s * s);
  const double w = std::sqrt(stiffness / p.m), v = std::sqrt(2.0 * g * fall);
  const double stance = 2.0 * (std::numbers::pi - std::atan(v * w / g)) / w;
  const double high = p.l0 * c + fall, hop = 2.0 * v / g + stance;
  const Trajectory run = Simulate(RobotDrop(p, {0.0, high, 0.0, 0.0, 0.0, 0.0}, 3.0 * hop));
  ASSERT_EQ(run.outcome, Outcome::kCompleted);
  EXPECT_NEAR(run.final_state[1], high, 1e-9);
  for (int i : {0, 2, 3, 4, 5}) EXPECT_NEAR(run.final_state[i], 0.0, 1e-8) << i;
}

// Without a torque, and with a rotor ever lighter, the leg turns freely about its foot: the
// straight leg of the hoppers.
TEST(RobotOnRods, WithoutAMotorItIsTheStraightLegOfAHopper) {
  Parameters<double> p = RodParametersFor(1);
  p.robot->pitch_inertia = 1e14;
  p.robot->motor_kp = p.robot->motor_kd = 0.0;
  const double theta = 0.2, fall = 0.02, vx = 0.8;
  const double down = std::sqrt(2.0 * fall / p.g), high = p.l0 * std::cos(theta) + fall;
  SimulationRequest hopper = RobotDrop(p, {0.0, high, vx, 0.0}, 0.2);
  hopper.law = Law::kStraightLeg;
  hopper.parameters.robot = MaybeRobot<double>();
  hopper.parameters.theta_td = theta;
  const Trajectory like = Simulate(hopper);
  ASSERT_EQ(like.outcome, Outcome::kCompleted);
  ASSERT_EQ(like.events.at(1).kind, EventKind::kLiftoff);
  // The leg comes down as it turns about its foot then.
  const double vy = -std::sqrt(2.0 * p.g * fall);
  const double turn = -(vx * std::cos(theta) + vy * std::sin(theta)) / p.l0;
  double before = 0.0;
  for (double J : {1e-6, 1e-7, 1e-8}) {
    p.robot->rotor_inertia = J;
    const Trajectory run =
        Simulate(RobotDrop(p, {0.0, high, vx, 0.0, 0.0, 0.0, theta - turn * down, turn}, 0.2));
    ASSERT_EQ(run.outcome, Outcome::kCompleted);
    double off = 0.0;
    for (int i = 0; i < 4; ++i)
      off = std::max(off, std::abs(run.final_state[i] - like.final_state[i]));
    off = std::max(off, std::abs(run.events.at(1).time - like.events.at(1).time));
    std::printf("a rod whose rotor has %.0e kg m^2 against the hopper's leg: %.1e\n", J, off);
    if (before > 0.0) {
      EXPECT_NEAR(off / before, 0.1, 0.03);
    }
    before = off;
  }
  EXPECT_LT(before, 1e-6);
}

// Two legs side by side in phase, on a body that cannot pitch, are one leg of twice the stiffness.
TEST(RobotOnRods, TwoLegsInPhaseAreOneOfTwiceTheStiffness) {
  Parameters<double> two = RodParametersFor(2), one = RodParametersFor(1);
  two.robot->pitch_inertia = one.robot->pitch_inertia = 1e14;
  two.robot->damping = one.robot->damping = 4e-4;
  two.robot->friction = one.robot->friction = 0.4;
  one.k *= 2.0;
  one.robot->lateral_stiffness *= 2.0;
  one.robot->rotor_inertia *= 2.0;
  one.robot->motor_kp *= 2.0;
  one.robot->motor_kd *= 2.0;
  const auto run = [](const Parameters<double>& p) {
    return Simulate(RobotDrop(p, {0.0, 0.22, 0.3, 0.0, 0.0, 0.0}, 0.6));
  };
  const Trajectory a = run(two), b = run(one);
  ASSERT_EQ(a.outcome, b.outcome);
  EXPECT_TRUE(a.has_simultaneous_events);
  EXPECT_GT(b.events.size(), 3u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(a.final_state[i], b.final_state[i], 1e-9) << i;
}

// ---- derivatives -----------------------------------------------------------------------------

// Random drops on two legs, feet that hold or slide, with and without mass.
TEST(RobotOnRods, DerivativesAreThoseOfDifferencesOverRandomSequences) {
  const std::vector<D> all = {D::Parameter(ParameterId::kStiffness),
                              D::Parameter(ParameterId::kLateralStiffness),
                              D::Parameter(ParameterId::kRestLength),
                              D::Parameter(ParameterId::kLegDamping),
                              D::Parameter(ParameterId::kPitchInertia),
                              D::Parameter(ParameterId::kComX),
                              D::Parameter(ParameterId::kMotorKp),
                              D::Parameter(ParameterId::kLegMass),
                              D::Parameter(ParameterId::kRotorInertia),
                              D::InitialState(1),
                              D::InitialState(2),
                              D::InitialState(4),
                              D::InitialState(5)};
  int columns = 0;
  std::map<std::string, int> kinds;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Parameters<double> p = RodParametersFor(2);
    p.robot->rotor_inertia = 4e-3;  // slower than a real one: fewer steps
    p.robot->com_x = 0.004;
    p.robot->damping = 3e-4;
    if (seed % 2 == 0) p.robot->leg_mass = 0.02;
    std::vector<D> directions = all;
    if (seed % 3 != 0) {
      p.robot->friction = 0.25 + 0.05 * seed;
      directions.push_back(D::Parameter(ParameterId::kFriction));
    }
    std::mt19937 random(seed);
    std::shuffle(directions.begin(), directions.end(), random);
    directions.resize(6);
    const SimulationRequest q = RandomRodDrop(p, seed, 0.3);
    const Trajectory run = Simulate(q);
    if (run.outcome != Outcome::kCompleted || run.has_simultaneous_events) continue;
    for (const Event& e : run.events) ++kinds[std::string(NameOf(e.kind))];
    columns += ExpectRobotExact(q, {}, directions);
  }
  for (const auto& [name, count] : kinds) std::printf("%s %d  ", name.c_str(), count);
  std::printf("\nderivatives on rods: %d columns\n", columns);
  EXPECT_GT(columns, 60);
  for (const char* kind : {"touchdown", "liftoff", "slide", "stick"}) EXPECT_GT(kinds[kind], 0);
}

// Each effect that means something on straight legs, off its null.
TEST(RobotOnRods, EffectsHaveTheDerivativesOfDifferences) {
  Parameters<double> p = RodParametersFor(2);
  p.robot->damping = 3e-4;
  p.robot->friction = 0.6;
  p.robot->rotor_inertia = 4e-3;
  SimulationRequest q = RobotDrop(p, {0.0, 0.19, 0.3, -0.2, 0.03, 0.2}, 0.12);
  for (const char* name :
       {"leg_stiffness_1", "leg_stiffness_2", "leg_damping_2", "motor_gain_1", "com_offset",
        "swinging_leg_mass", "ground_slope", "rest_length_scale", "lateral_stiffness_scale"}) {
    const Effect& effect = *FindEffect(name);
    EXPECT_TRUE(AppliesTo(effect, Law::kRobot, LegMass::kNone, 0, {2, true})) << name;
    std::array<EffectSetting, 1> effects = {EffectSetting::Null(effect)};
    effects[0].values[0] += 0.3 * effect.info.parameters[0].typical;
    q.effects = effects;
    EXPECT_GT(ExpectRobotExact(q, {}, {D::EffectParameter(0, 0)}), 0) << name;
  }
  EXPECT_FALSE(
      AppliesTo(*FindEffect("rest_radius_scale"), Law::kRobot, LegMass::kNone, 0, {2, true}));
  for (const char* of_rods : {"rest_length_scale", "lateral_stiffness_scale"})
    EXPECT_FALSE(AppliesTo(*FindEffect(of_rods), Law::kRobot, LegMass::kNone, 0, {2, false}));
}

}  // namespace
}  // namespace hoplab
