#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "model/hybrid/engine.h"
#include "model/mechanisms/robot.h"
#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// Friction of a robot's hips, M99.

namespace hoplab {
namespace {

using namespace testing;

// A motor that is held and has no limit brakes its rotor by k_d of its rate: so does the hip.
TEST(HipFriction, AViscousOneIsADerivativeGainOfHeldMotors) {
  for (const double leg_mass : {0.0, 0.02}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.8;
    p.robot->damping = 3e-4;
    p.robot->leg_mass = leg_mass;
    SimulationRequest q = RobotDrop(p, {0.0, 0.21, 0.4, -0.2, 0.03, 0.2}, 0.3);
    q.parameters.robot->motor_kd = p.robot->motor_kd + 0.3;
    const Trajectory braked = Simulate(q);
    ASSERT_EQ(braked.outcome, Outcome::kCompleted);
    const auto differs_by = [&](const std::vector<EffectSetting>& effects) {
      q.parameters.robot->motor_kd = p.robot->motor_kd;
      q.effects = effects;
      const Trajectory run = Simulate(q);
      double most = 0.0;
      for (std::size_t k = 0; k < run.final_state.size(); ++k)
        most = std::max(most, std::abs(run.final_state[k] - braked.final_state[k]));
      return most;
    };
    EXPECT_LT(differs_by({EffectOf("hip_viscous_friction", 0.3)}), 1e-8);
    EXPECT_LT(differs_by({EffectOf("hip_viscous_friction_1", 0.3),
                          EffectOf("hip_viscous_friction_2", 0.3)}),
              1e-8);
    EXPECT_GT(differs_by({EffectOf("hip_viscous_friction_1", 0.3)}), 1e-3);
    EXPECT_GT(differs_by({}), 1e-3);
  }
}

// In the air a rotor without a controller is braked alone: J dw/dt = -b w - c, until it stops.
TEST(HipFriction, BrakesAFreeRotorAsItsClosedFormSays) {
  Parameters<double> p = RobotParametersFor(2);
  RobotParameters<double>& robot = *p.robot;
  robot.motor_kp = robot.motor_kd = 0.0;
  const double begins[] = {6.0, -2.0}, time = 0.12, J = robot.rotor_inertia, b = 8e-3, c = 0.03;
  SimulationRequest q =
      RobotDrop(p, {0.0, 2.0, 0.3, 0.0, 0.0, 0.1, 0.5, 0.4, begins[0], begins[1], 0.0, 0.0}, time);
  const auto run_with = [&](const std::vector<EffectSetting>& friction) {
    q.effects = friction;
    Trajectory run = Simulate(q);
    EXPECT_EQ(run.outcome, Outcome::kCompleted);
    return run;
  };
  const auto rate = [](const Trajectory& run, int leg) {
    return run.final_state[static_cast<std::size_t>(8 + leg)];
  };
  for (int leg : {0, 1}) {
    const std::string other = std::to_string(2 - leg);
    EXPECT_NEAR(rate(run_with({EffectOf("hip_viscous_friction", b)}), leg),
                begins[leg] * std::exp(-b * time / J), 1e-9);
    EXPECT_NEAR(rate(run_with({EffectOf("hip_viscous_friction_" + other, b)}), leg), begins[leg],
                1e-9);
    EXPECT_NEAR(rate(run_with({EffectOf("hip_coulomb_friction_" + other, c)}), leg), begins[leg],
                1e-9);
    // Alone and with the other: when it stops, and how far it has turned by then.
    const double side = begins[leg] > 0.0 ? 1.0 : -1.0, w = std::abs(begins[leg]);
    for (const bool viscous : {false, true}) {
      std::vector<EffectSetting> effects = {EffectOf("hip_coulomb_friction", c)};
      if (viscous) effects.push_back(EffectOf("hip_viscous_friction", b));
      const double stops = viscous ? J / b * std::log1p(b * w / c) : J * w / c;
      const double turned = viscous ? J / b * (w - c / b * std::log1p(b * w / c)) : 0.5 * w * stops;
      const bool in_time = stops < time;
      const Trajectory run = run_with(effects);
      const auto found = std::find_if(run.events.begin(), run.events.end(), [&](const Event& e) {
        return e.kind == EventKind::kHipStop && e.leg == leg;
      });
      ASSERT_EQ(found != run.events.end(), in_time) << leg << viscous;
      if (!in_time) continue;
      EXPECT_NEAR(found->time, stops, 1e-10);
      EXPECT_EQ(rate(run, leg), 0.0);
      EXPECT_NEAR(run.final_state[static_cast<std::size_t>(6 + leg)],
                  (leg == 0 ? 0.5 : 0.4) + side * turned, 1e-10);
    }
  }
}

// A held motor without a derivative gain swings about its reference, each swing shorter by 2 c/kp,
// until one ends within c/kp of it: there the hip stays.
TEST(HipFriction, SwingsShrinkByASeriesUntilTheHipIsHeld) {
  Parameters<double> p = RobotParametersFor(1);
  RobotParameters<double>& robot = *p.robot;
  robot.motor_kd = 0.0;
  const double c = 0.3, dead = c / robot.motor_kp, J = robot.rotor_inertia,
               half = std::numbers::pi * std::sqrt(J / robot.motor_kp);
  for (const double begins : {0.9 * dead, 4.7 * dead, -6.3 * dead}) {
    SimulationRequest q =
        RobotDrop(p, {0.0, 2.0, 0.3, 0.0, 0.0, 0.1, robot.angle[0] + begins, 0.0, 0.0}, 8.0 * half);
    const std::array effects = {EffectOf("hip_coulomb_friction_1", c)};
    q.effects = effects;
    const Trajectory run = Simulate(q);
    ASSERT_EQ(run.outcome, Outcome::kCompleted);
    double at = begins;
    int swings = 0;
    for (; std::abs(at) > dead; ++swings) at = -(at - std::copysign(2.0 * dead, at));
    std::vector<double> stops;
    for (const Event& e : run.events)
      if (e.kind == EventKind::kHipStop) stops.push_back(e.time);
    ASSERT_EQ(stops.size(), static_cast<std::size_t>(swings)) << begins;
    for (int k = 0; k < swings; ++k)
      EXPECT_NEAR(stops[static_cast<std::size_t>(k)], (k + 1) * half, 1e-10);
    EXPECT_NEAR(run.final_state[6] - robot.angle[0], at, 1e-10);
    EXPECT_EQ(run.final_state[7], 0.0);
  }
}

// A hip that friction holds through it all is one whose motor is locked.
TEST(HipFriction, EnoughOfItLocksTheMotor) {
  for (const double lag : {0.0, 2e-6, 3e-3}) {
    Parameters<double> p = RobotParametersFor(3);
    p.robot->friction = 0.8;
    p.robot->damping = 3e-4;
    p.robot->motor_lag = lag;
    SimulationRequest q = RobotDrop(p, {0.0, 0.21, 0.4, -0.2, 0.03, 0.2}, 0.3);
    const std::array effects = {EffectOf("hip_coulomb_friction", 500.0)};
    q.effects = effects;
    const Trajectory held = Simulate(q);
    q.effects = {};
    q.parameters.robot->control = MotorControl::kLocked;
    q.parameters.robot->motor_lag = 0.0;
    const Trajectory locked = Simulate(q);
    ASSERT_EQ(held.outcome, Outcome::kCompleted);
    ASSERT_EQ(held.events.size(), locked.events.size());
    for (std::size_t k = 0; k < locked.final_state.size(); ++k)
      EXPECT_NEAR(held.final_state[k], locked.final_state[k], 1e-9) << k;
  }
}

// Where friction no longer holds a hip, that begins to turn from rest: the equations of a hip that
// turns, which know nothing of what held it, give it no acceleration at that instant.
TEST(HipFriction, LetsGoOfAHipThatDoesNotJump) {
  for (const double leg_mass : {0.0, 0.02}) {
    Parameters<double> p = RobotParametersFor(2);
    p.robot->friction = 0.8;
    p.robot->damping = 3e-4;
    p.robot->leg_mass = leg_mass;
    SimulationRequest q = RobotDrop(p, {0.0, 0.21, 0.4, -0.2, 0.03, 0.2}, 0.25);
    const double c = 0.4;
    const std::array effects = {EffectOf("hip_coulomb_friction", c)};
    q.effects = effects;
    const Trajectory run = Simulate(q);
    ASSERT_EQ(run.outcome, Outcome::kCompleted);
    int slips = 0;
    for (const Event& e : run.events) {
      if (e.kind != EventKind::kHipSlip) continue;
      ++slips;
      q.horizon = e.time + 1e-9;
      const Trajectory to_slip = Simulate(q);
      const auto rate = static_cast<std::size_t>(8 + e.leg);
      EXPECT_LT(std::abs(to_slip.final_state[rate]), 1e-9);
      EXPECT_LT(std::abs(to_slip.final_rate[rate]), 1e-5 * c / p.robot->rotor_inertia) << e.time;
    }
    EXPECT_GE(slips, 2) << leg_mass;
  }
}

// How far outside their cones feet are that hold or slide, and hips that are held or turn, four
// times a millisecond.
class ConeRows final : public RowReader<double> {
 public:
  ConeRows(const HybridSystem<double>& system, double horizon)
      : system_(system), count_(static_cast<int>(4e3 * horizon)) {}
  int count() const override { return count_; }
  double Time(int i) const override { return 0.25e-3 * (i + 0.5); }
  void Read(int, Mode mode, const double& time, const double* z) override {
    double g[kMaxGuards];
    system_.Guards(mode, time, z, g);
    for (int k = 0; k < system_.GuardCount(mode); ++k) {
      const GuardSpec guard = system_.Guard(mode, k);
      if (guard.event != EventKind::kSlide && guard.event != EventKind::kStick &&
          guard.event != EventKind::kHipSlip && guard.event != EventKind::kHipStop)
        continue;
      ++asked;
      outside = std::max(outside, -g[k] / guard.scale);
    }
  }
  double outside = 0.0;
  int asked = 0;

 private:
  const HybridSystem<double>& system_;
  int count_;
};

// No foot holds and no hip is held by more friction than there is, and none moves the other way
// than its friction has it, whichever of them lets go or comes to rest first.
TEST(HipFriction, AllStayWithinTheirCones) {
  double outside = 0.0;
  int asked = 0, runs = 0;
  std::map<EventKind, int> seen;
  for (const bool walks : {false, true}) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
      MechanismSetup<double> setup;
      Parameters<double>& p = setup.parameters = walks ? Walking() : RobotParametersFor(3);
      p.robot->friction = 0.3 + 0.004 * seed;
      p.robot->damping = 3e-4;
      p.robot->leg_mass = 0.1;
      p.robot->hip_coulomb.fill(0.1 * (1 + seed % 8));
      const SimulationRequest q = RandomRobotDrop(p, seed, 0.35);
      setup.parameters = q.parameters;
      MechanismSetup<Jet<1>> rate_setup;
      rate_setup.parameters = ConvertParameters<Jet<1>>(setup.parameters);
      Robot<double> robot(setup), values(setup);
      Robot<Jet<1>> rates(rate_setup);
      ConeRows rows(robot, q.horizon);
      Trajectory run;
      IntegratorOptions options;
      Engine<double> engine({robot, values, rates}, options, {.horizon = q.horizon}, rows, run);
      std::vector<double> z(static_cast<std::size_t>(robot.size()), 0.0);
      std::copy(q.initial.begin(), q.initial.end(), z.begin());
      robot.CompleteStart(z.data(), static_cast<int>(q.initial.size()));
      engine.Run(Mode::kFlight, z.data());
      EXPECT_NE(run.outcome, Outcome::kChattering) << seed << walks;
      for (const Event& e : run.events) ++seen[e.kind];
      outside = std::max(outside, rows.outside);
      asked += rows.asked;
      ++runs;
    }
  }
  std::printf("  %d runs, %d cones, %d hips stop, %d slip, %d feet slide: outside by %.1e\n", runs,
              asked, seen[EventKind::kHipStop], seen[EventKind::kHipSlip], seen[EventKind::kSlide],
              outside);
  EXPECT_GT(seen[EventKind::kHipSlip], 50);
  EXPECT_GT(seen[EventKind::kSlide], 20);
  EXPECT_LT(outside, 1e-6);
}

// A hip that is held where a run goes on forgets how fast it might have turned.
TEST(HipFriction, AHeldHipHasNoDerivativeByItsRate) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->friction = 0.8;
  SimulationRequest q = RobotDrop(
      p, {0.0, 0.3, 0.3, 0.0, 0.02, 0.1, p.robot->angle[0], p.robot->angle[1], 0.0, 0.0}, 0.05);
  const std::array effects = {EffectOf("hip_coulomb_friction_1", 0.5)};
  const std::array directions = {SensitivityDirection::InitialState(8),
                                 SensitivityDirection::InitialState(9)};
  q.effects = effects;
  q.directions = directions;
  const Trajectory run = Simulate(q);
  ASSERT_EQ(run.outcome, Outcome::kCompleted);
  // By (component, direction): the angle of leg 1 by its rate, that of leg 2 by its own.
  EXPECT_EQ(run.final_sensitivities[2 * 6], 0.0);
  EXPECT_EQ(run.final_sensitivities[2 * 8], 0.0);
  EXPECT_GT(std::abs(run.final_sensitivities[2 * 7 + 1]), 1e-6);
}

// ---- derivatives -----------------------------------------------------------------------------

struct Rubbing {
  std::string name;
  MotorControl control;
  double leg_mass, lag, play, torque;
};
void PrintTo(const Rubbing& g, std::ostream* out) { *out << g.name; }

class HipFrictionGradient : public ::testing::TestWithParam<Rubbing> {};

TEST_P(HipFrictionGradient, AgreesWithDifferences) {
  using D = SensitivityDirection;
  const Rubbing& at = GetParam();
  Parameters<double> p = RobotParametersFor(2);
  RobotParameters<double>& robot = *p.robot;
  robot.friction = 0.9;
  robot.damping = 3e-4;
  robot.leg_mass = at.leg_mass;
  robot.control = at.control;
  robot.period = 0.4;
  robot.duty = 0.6;
  robot.sweep = 0.8;
  robot.offset = 0.3;
  robot.phase = {0.0, 0.3};
  robot.torque_limit = 8.0;
  robot.motor_lag = at.lag;
  robot.rotor_inertia = 4e-3;
  std::vector<EffectSetting> effects = {EffectOf("hip_coulomb_friction_1", at.torque),
                                        EffectOf("hip_coulomb_friction_2", 0.7 * at.torque),
                                        EffectOf("hip_viscous_friction_1", 0.02)};
  if (at.play > 0.0) effects.push_back(EffectOf("backlash_1", at.play));
  const std::vector<D> directions = {D::EffectParameter(0, 0),
                                     D::EffectParameter(1, 0),
                                     D::EffectParameter(2, 0),
                                     D::Parameter(ParameterId::kE),
                                     D::Parameter(ParameterId::kLegMass),
                                     D::Parameter(ParameterId::kMotorKp),
                                     D::Parameter(ParameterId::kRotorInertia),
                                     D::InitialState(1),
                                     D::InitialState(4)};
  int checked = 0, stops = 0, slips = 0;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    SimulationRequest q = RandomRobotDrop(p, seed, 0.16);
    q.effects = effects;
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    const Trajectory run = Simulate(q);
    for (const Event& e : run.events) {
      stops += e.kind == EventKind::kHipStop;
      slips += e.kind == EventKind::kHipSlip;
    }
    checked += ExpectRobotExact(q, {}, directions);
  }
  EXPECT_GT(checked, 45);
  EXPECT_GT(stops, 0);
  EXPECT_GT(slips, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, HipFrictionGradient,
    ::testing::Values(Rubbing{"held", MotorControl::kHeld, 0.0, 0.0, 0.0, 0.3},
                      Rubbing{"heavy_legs", MotorControl::kHeld, 0.01, 0.0, 0.0, 0.3},
                      Rubbing{"clock", MotorControl::kClock, 0.0, 0.0, 0.0, 1.0},
                      Rubbing{"clock_heavy_legs_lag", MotorControl::kClock, 0.01, 2e-3, 0.0, 1.0},
                      Rubbing{"short_lag", MotorControl::kHeld, 0.01, 5e-6, 0.0, 0.3},
                      Rubbing{"play", MotorControl::kHeld, 0.01, 0.0, 0.012, 0.3}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace hoplab
