#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/support/effect_requests.h"
#include "tests/support/robot_columns.h"
#include "tests/support/robot_energy.h"
#include "tests/support/robot_requests.h"

// Gears with play between a robot's motors and its hips (M96).

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

EffectSetting Play(double play, std::string_view name = "backlash") {
  EffectSetting setting = EffectSetting::Null(*FindEffect(name));
  setting.values[0] = play;
  return setting;
}

Parameters<double> HeldParameters(double leg_mass = 0.0) {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->angle = {0.5, 0.4};
  p.robot->friction = 0.9;
  p.robot->damping = 3e-4;
  p.robot->leg_mass = leg_mass;
  return p;
}

SimulationRequest GearedDrop(const Parameters<double>& p, double horizon) {
  return RobotDrop(p, {0.0, 0.2, 0.3, -0.2, 0.03, 0.2}, horizon);
}

double MostOff(const Trajectory& a, const Trajectory& b) {
  double most = 0.0;
  for (const std::size_t i : {0, 1, 4})
    most = std::max(most, std::abs(a.final_state[i] - b.final_state[i]));
  return most;
}

// Without play, and with less than any gear has, it changes nothing.
TEST(Backlash, OfNoPlayChangesNothingBitForBit) {
  for (const double leg_mass : {0.0, 0.01}) {
    SimulationRequest q = GearedDrop(HeldParameters(leg_mass), 0.3);
    const Trajectory without = Simulate(q);
    for (const char* name : {"backlash", "backlash_1", "backlash_2"}) {
      for (const double play : {0.0, 0.99 * Gear<double>::kLeastPlay}) {
        const std::array effects = {Play(play, name)};
        const std::vector<D> directions = {D::EffectParameter(0, 0)};
        q.effects = effects;
        q.directions = {};
        EXPECT_EQ(Simulate(q).final_state, without.final_state) << name;
        // Nor does its derivative: it has a threshold.
        q.directions = directions;
        for (const double slope : Simulate(q).final_sensitivities) EXPECT_EQ(slope, 0.0) << name;
      }
    }
  }
}

// A rotor under a constant torque in the air goes through its play alone, then it and the hub swing
// against each other on the teeth: closed form, up to where they part again.
TEST(Backlash, IsFreeMotionThroughThePlayAndThenASpring) {
  Parameters<double> p = HeldParameters();
  RobotParameters<double>& robot = *p.robot;
  robot.control = MotorControl::kRecorded;
  robot.starts_at_angles = true;
  const double J = robot.rotor_inertia, torque = 0.05, play = 0.02, tooth = 20.0, share = 0.1;
  const std::vector<double> times = {0.0}, pushes = {torque}, rests = {0.0};
  const std::vector<DrivenInput> inputs = {
      {.kind = InputKind::kHipTorque1, .times = times, .values = pushes},
      {.kind = InputKind::kHipTorque2, .times = times, .values = rests}};
  std::array effects = {Play(play)};
  effects[0].values = {play, tooth, 0.0, share};
  const double hub = share * J, rotor = J - hub, k = 2.0 * tooth / play;
  const double meet = std::sqrt(play * rotor / torque), speed = torque * meet / rotor;
  const double w = std::sqrt(k * (1.0 / rotor + 1.0 / hub));
  const double rest = torque / rotor / (w * w);
  const std::vector<D> directions = {D::EffectParameter(0, 0)};
  for (const double after : {-0.004, 0.1e-3, 0.3e-3, 0.6e-3}) {
    SimulationRequest q = RobotDrop(p, {0.0, 2.0, 0.0, 0.0, 0.0, 0.0}, meet + after);
    q.inputs = inputs;
    q.effects = effects;
    q.directions = directions;
    const Trajectory run = Simulate(q);
    ASSERT_EQ(run.outcome, Outcome::kCompleted);
    ASSERT_EQ(run.final_state.size(), 16u);
    const double t = meet + after;
    const double press = after < 0.0
                             ? 0.5 * torque / rotor * t * t - 0.5 * play
                             : rest * (1.0 - std::cos(w * after)) + speed / w * std::sin(w * after);
    const double press_rate = after < 0.0
                                  ? torque / rotor * t
                                  : rest * w * std::sin(w * after) + speed * std::cos(w * after);
    // What both have of the torque's impulse, and how they share it.
    const double hip_rate = (torque * t - rotor * press_rate) / J;
    const double hip = (0.5 * torque * t * t - rotor * (press + 0.5 * play)) / J;
    EXPECT_NEAR(run.final_state[6], 0.5 + hip, 1e-11) << after;
    EXPECT_NEAR(run.final_state[8], hip_rate, 1e-8) << after;
    EXPECT_NEAR(run.final_state[12], press + 0.5 * play, 1e-11) << after;
    EXPECT_NEAR(run.final_state[13], hip_rate + press_rate, 1e-8) << after;
    EXPECT_EQ(run.events.size(), after < 0.0 ? 0u : 1u);
    if (after < 0.0) continue;
    EXPECT_EQ(run.events[0].kind, EventKind::kGearMesh);
    EXPECT_NEAR(run.events[0].time, meet, 1e-12);
    EXPECT_NEAR(run.event_time_sensitivities[0], 0.5 * meet / play, 1e-9);
  }
}

// The encoder sits on the motor: it reads the rotor, and the controller follows it.
TEST(Backlash, IsSeenByNoEncoderOnTheMotor) {
  SimulationRequest q = GearedDrop(HeldParameters(), 0.1);
  const std::array effects = {Play(0.02)};
  const std::vector<double> rows = {0.1};
  const std::array channels = {Channel::kLegAngle1, Channel::kHipTorque1};
  q.effects = effects;
  q.row_times = rows;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  const RobotParameters<double>& robot = *q.parameters.robot;
  const double rotor = run.final_state[6] + run.final_state[12];
  EXPECT_NE(run.final_state[12], 0.0);
  EXPECT_NEAR(run.samples[0], rotor, 1e-12);
  EXPECT_NEAR(run.samples[1],
              robot.motor_kp * (robot.angle[0] - rotor) - robot.motor_kd * run.final_state[13],
              1e-9);
}

TEST(Backlash, OfEachMotorIsThatOfAll) {
  SimulationRequest q = GearedDrop(HeldParameters(0.01), 0.2);
  const std::array all = {Play(0.015)};
  const std::array each = {Play(0.015, "backlash_1"), Play(0.015, "backlash_2")};
  const std::array one = {Play(0.015, "backlash_2")};
  q.effects = all;
  const Trajectory both = Simulate(q);
  q.effects = each;
  EXPECT_EQ(Simulate(q).final_state, both.final_state);
  q.effects = one;
  const Trajectory second = Simulate(q);
  EXPECT_EQ(second.final_state.size() + 2, both.final_state.size());
  for (const Event& e : second.events) EXPECT_TRUE(e.kind != EventKind::kGearMesh || e.leg == 1);
}

// Finer and finer gears are none; harder and harder teeth have a limit.
TEST(Backlash, GoesOverIntoARigidGear) {
  Parameters<double> p = HeldParameters();
  p.robot->friction = std::numeric_limits<double>::infinity();
  SimulationRequest q = GearedDrop(p, 0.09);
  const Trajectory rigid = Simulate(q);
  double last = std::numeric_limits<double>::infinity();
  for (const double play : {0.01, 0.005, 0.0025, 0.00125, 0.000625}) {
    const std::array effects = {Play(play)};
    q.effects = effects;
    const double off = MostOff(Simulate(q), rigid);
    std::printf("  play %.5f rad: off by %.2e\n", play, off);
    EXPECT_LT(off, 0.75 * last);
    last = off;
  }
  EXPECT_LT(last, 3e-4);
  last = std::numeric_limits<double>::infinity();
  const auto with_teeth = [&](double tooth) {
    std::array effects = {Play(0.02)};
    effects[0].values[1] = tooth;
    q.effects = effects;
    return Simulate(q);
  };
  Trajectory before = with_teeth(20.0);
  for (const double tooth : {80.0, 320.0, 1280.0}) {
    const Trajectory now = with_teeth(tooth);
    const double off = MostOff(now, before);
    std::printf("  teeth of %.0f N m: moved by %.2e\n", tooth, off);
    EXPECT_LT(off, 0.6 * last);
    last = off;
    before = now;
  }
}

// ---- energy ----------------------------------------------------------------------------------

Parameters<double> OnIce(double damping) {
  Parameters<double> p = RobotParametersFor(2);
  RobotParameters<double>& robot = *p.robot;
  robot.friction = 0.0;
  robot.motor_kd = 0.0;
  robot.play.fill(0.02);
  robot.tooth_torque.fill(20.0);
  robot.tooth_damping.fill(damping);
  robot.hub_share.fill(0.1);
  return p;
}

TEST(Backlash, KeepsEnergyWhereItsTeethDoNotDamp) {
  int meshes = 0;
  double worst = 0.0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const EnergyRun at = RunWithEnergy(RandomRobotDrop(OnIce(0.0), seed, 0.6));
    for (const Event& e : at.run.events) meshes += e.kind == EventKind::kGearMesh;
    for (const double energy : at.energy)
      worst = std::max(worst, std::abs(energy - at.energy.front()) / at.energy.front());
  }
  std::printf("  %d meetings of teeth: energy off by %.1e\n", meshes, worst);
  EXPECT_GT(meshes, 50);
  EXPECT_LT(worst, 1e-9);
}

TEST(Backlash, NeverCreatesEnergy) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const EnergyRun at = RunWithEnergy(RandomRobotDrop(OnIce(0.2), seed, 0.6));
    for (std::size_t i = 0; i + 1 < at.energy.size(); ++i)
      EXPECT_LE(at.energy[i + 1], at.energy[i] + 1e-9 * at.energy.front()) << at.times[i];
    EXPECT_LT(at.energy.back(), at.energy.front());
  }
}

// Motors that rest in the air do not steer the step: what a mass of the legs would do to them is
// followed all the same. Against differences, from null on.
TEST(RobotInTheAir, RestingMotorsAreDifferentiatedExactly) {
  Parameters<double> p = HeldParameters();
  std::array effects = {EffectSetting::Null(*FindEffect("swinging_leg_mass"))};
  for (const double lag : {0.0, 3e-4}) {
    for (const double friction : {0.0, 3.0}) {  // of the hips [N m]
      p.robot->motor_lag = lag;
      p.robot->hip_coulomb.fill(friction);
      SimulationRequest q = GearedDrop(p, 0.1);
      q.effects = effects;
      EXPECT_GE(ExpectRobotExact(q, {}, {D::EffectParameter(0, 0)}), 2) << lag << ", " << friction;
    }
  }
}

// ---- derivatives -----------------------------------------------------------------------------

struct Geared {
  std::string name;
  MotorControl control;
  double leg_mass, lag;
};
void PrintTo(const Geared& g, std::ostream* out) { *out << g.name; }

class BacklashGradient : public ::testing::TestWithParam<Geared> {};

TEST_P(BacklashGradient, AgreesWithDifferences) {
  Parameters<double> p = HeldParameters(GetParam().leg_mass);
  RobotParameters<double>& robot = *p.robot;
  robot.rotor_inertia = 4e-3;  // slower than a real one: fewer steps
  robot.control = GetParam().control;
  robot.period = 0.4;
  robot.duty = 0.6;
  robot.sweep = 0.8;
  robot.offset = 0.3;
  robot.phase = {0.0, 0.3};
  robot.torque_limit = 5.0;
  std::array<EffectSetting, 2> effects = {Play(0.012),
                                          EffectSetting::Null(*FindEffect("motor_lag"))};
  effects[0].values[3] = 0.2;
  effects[1].values[0] = GetParam().lag;
  SimulationRequest q = GearedDrop(p, 0.12);
  q.effects = effects;
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  const std::vector<D> directions = {D::EffectParameter(0, 0),
                                     D::EffectParameter(0, 1),
                                     D::EffectParameter(0, 2),
                                     D::EffectParameter(0, 3),
                                     D::Parameter(ParameterId::kE),
                                     D::Parameter(ParameterId::kMotorKp),
                                     D::Parameter(ParameterId::kRotorInertia),
                                     D::InitialState(1),
                                     D::InitialState(4)};
  const Trajectory run = Simulate(q);
  EXPECT_TRUE(std::any_of(run.events.begin(), run.events.end(),
                          [](const Event& e) { return e.kind == EventKind::kGearMesh; }));
  EXPECT_GT(ExpectRobotExact(q, {}, directions), 20);
}

INSTANTIATE_TEST_SUITE_P(Cases, BacklashGradient,
                         ::testing::Values(Geared{"held", MotorControl::kHeld, 0.0, 0.0},
                                           Geared{"heavy_legs", MotorControl::kHeld, 0.01, 0.0},
                                           Geared{"clock", MotorControl::kClock, 0.0, 0.0},
                                           Geared{"clock_heavy_legs_lag", MotorControl::kClock,
                                                  0.01, 2e-3},
                                           Geared{"short_lag", MotorControl::kHeld, 0.01, 5e-6}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace hoplab
