#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "model/mechanisms/motor_clock.h"
#include "tests/support/effect_requests.h"
#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"

// A robot whose motors are told recorded torques, or follow recorded references (M95).

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

constexpr double kPeriod = 0.4, kDuty = 0.6, kSweep = 0.8, kOffset = 0.3;

struct Column {
  std::vector<double> times, values;
  DrivenInput Of(InputKind kind, bool held = false, double delay = 0.0) const {
    return {.kind = kind, .times = times, .values = values, .held = held, .delay = delay};
  }
};
template <class F>
Column ColumnOf(double step, double end, const F& f) {
  Column column;
  for (int i = -2; i * step < end; ++i) {
    column.times.push_back(i * step);
    column.values.push_back(f(i * step));
  }
  return column;
}

Parameters<double> DrivenParameters(double leg_mass = 0.0) {
  Parameters<double> p = RobotParametersFor(2);
  RobotParameters<double>& robot = *p.robot;
  robot.control = MotorControl::kRecorded;
  robot.starts_at_angles = true;
  robot.angle = {0.5, 0.4};
  robot.friction = 0.9;
  robot.damping = 3e-4;
  robot.leg_mass = leg_mass;
  return p;
}

SimulationRequest Drop(const Parameters<double>& p, double horizon) {
  return RobotDrop(p, {0.0, 0.2, 0.3, -0.2, 0.03, 0.2}, horizon);
}

// ---- closed forms ----------------------------------------------------------------------------

// In the air a rotor under a torque that is held and jumps goes along two parabolas, whatever the
// limit of its controller.
TEST(RecordedTorque, MovesARotorInTheAirAlongParabolas) {
  Parameters<double> p = DrivenParameters();
  p.robot->torque_limit = 1e-3;
  p.robot->rate = {2.0, 0.0};
  SimulationRequest q = RobotDrop(p, {0.0, 2.0, 0.3, 0.0, 0.0, 0.0}, 0.1);
  const Column column{{0.0, 0.04}, {0.02, -0.03}};
  const std::vector<DrivenInput> inputs = {column.Of(InputKind::kHipTorque1, true, 0.01),
                                           column.Of(InputKind::kHipTorque2, true, 0.01)};
  const std::vector<D> directions = {D::InputDelay(0), D::InputScale(0)};
  q.inputs = inputs;
  q.directions = directions;
  const Trajectory run = Simulate(q);
  ASSERT_EQ(run.outcome, Outcome::kCompleted);
  const double J = p.robot->rotor_inertia, a = 0.02 / J, b = -0.03 / J, before = 0.05, after = 0.05;
  EXPECT_NEAR(run.final_state[8], 2.0 + a * before + b * after, 1e-11);
  EXPECT_NEAR(
      run.final_state[6],
      0.5 + 2.0 * 0.1 + 0.5 * a * before * before + a * before * after + 0.5 * b * after * after,
      1e-11);
  EXPECT_NEAR(run.final_sensitivities[8 * 2 + 0], a - b, 1e-8);
  EXPECT_NEAR(run.final_sensitivities[6 * 2 + 0], (a - b) * after, 1e-9);
  EXPECT_NEAR(run.final_sensitivities[8 * 2 + 1], a * before + b * after, 1e-9);
}

// The log of a clock's own angle has rows where the clock has its corners: it is the clock.
TEST(RecordedReference, OfAClockIsTheClock) {
  for (const double leg_mass : {0.0, 0.01}) {
    Parameters<double> p = DrivenParameters(leg_mass);
    RobotParameters<double>& robot = *p.robot;
    robot.starts_at_angles = false;
    robot.torque_limit = 6.0;
    robot.period = kPeriod;
    robot.duty = kDuty;
    robot.sweep = kSweep;
    robot.offset = kOffset;
    robot.phase = {0.0, 0.45};
    std::array<Column, 2> columns;
    std::vector<double> corners;
    for (int leg = 0; leg < 2; ++leg) {
      const MotorClock<double> clock(robot, leg, 0.0);
      int piece = clock.PieceAt(-0.3);
      for (double t = -0.3; t < 0.75; t = clock.End(piece++)) {
        columns[leg].times.push_back(t);
        columns[leg].values.push_back(clock.Angle(piece, t));
        corners.push_back(t);
      }
    }
    std::vector<DrivenInput> inputs = {columns[0].Of(InputKind::kLegAngle1),
                                       columns[1].Of(InputKind::kLegAngle2)};
    SimulationRequest driven = Drop(p, 0.3), clocked = Drop(p, 0.3);
    driven.inputs = inputs;
    clocked.parameters.robot->control = MotorControl::kClock;
    const std::vector<D> delays = {D::InputDelay(0), D::InputDelay(1),
                                   D::Parameter(ParameterId::kE)};
    const std::vector<D> phases = {D::Parameter(ParameterId::kClockPhase1),
                                   D::Parameter(ParameterId::kClockPhase2),
                                   D::Parameter(ParameterId::kE)};
    driven.directions = delays;
    clocked.directions = phases;
    const Trajectory by_log = Simulate(driven), by_clock = Simulate(clocked);
    ASSERT_EQ(by_clock.outcome, Outcome::kCompleted);
    ASSERT_EQ(EventNames(by_log), EventNames(by_clock));
    EXPECT_GT(by_clock.events.size(), 5u);
    double off = 0.0, slope = 0.0, most = 0.0;
    for (std::size_t i = 0; i < by_clock.final_state.size(); ++i) {
      off = std::max(off, std::abs(by_log.final_state[i] - by_clock.final_state[i]));
      for (std::size_t k = 0; k < 3; ++k) {
        // A log that is late by dt is a clock whose phase is -dt/period ahead.
        const double of = k < 2 ? -1.0 / kPeriod : 1.0;
        const double want = of * by_clock.final_sensitivities[3 * i + k];
        const double scale = k < 2 ? 1.0 : p.E;
        slope = std::max(slope, scale * std::abs(by_log.final_sensitivities[3 * i + k] - want));
        most = std::max(most, scale * std::abs(want));
      }
    }
    std::printf("  a clock's log: off by %.1e, derivatives by %.1e of %.1e\n", off, slope, most);
    EXPECT_LT(off, 1e-7) << leg_mass;
    EXPECT_LT(slope, 1e-6 * most) << leg_mass;
  }
}

// Motors that are held, their torques logged every h seconds and told again. A torque that is
// linear between its rows is off by an eighth of its second difference D there; a rotor that
// nothing holds would be off by T/J times the sum of h D/8 after T. D falls as h^2 where the torque
// is smooth and as h over the one row where its slope jumps: the sum goes as h^2 either way.
TEST(RecordedTorque, OfHeldMotorsMovesThemAsTheyMoved) {
  Parameters<double> p = DrivenParameters();
  const double horizon = 0.25;
  SimulationRequest q = Drop(p, horizon);
  q.parameters.robot->control = MotorControl::kHeld;
  const Trajectory held = Simulate(q);
  ASSERT_EQ(held.outcome, Outcome::kCompleted);
  std::vector<double> errors;
  std::vector<std::vector<double>> ends;
  for (const double step : {4e-4, 2e-4, 1e-4}) {
    SimulationRequest logged = q;
    std::vector<double> rows;
    for (int i = 0; i * step <= horizon + 1e-9; ++i) rows.push_back(i * step);
    const std::array channels = {Channel::kHipTorque1, Channel::kHipTorque2};
    logged.row_times = rows;
    logged.channels = channels;
    logged.horizon = rows.back();
    const Trajectory log = Simulate(logged);
    std::array<Column, 2> columns{Column{rows, {}}, Column{rows, {}}};
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t motor = 0; motor < 2; ++motor)
        columns[motor].values.push_back(log.samples[2 * i + motor]);
    const std::vector<DrivenInput> inputs = {columns[0].Of(InputKind::kHipTorque1),
                                             columns[1].Of(InputKind::kHipTorque2)};
    SimulationRequest told = Drop(p, horizon);
    told.inputs = inputs;
    const Trajectory again = Simulate(told);
    ASSERT_EQ(EventNames(again), EventNames(held));
    double error = 0.0, difference = 0.0;
    for (const std::size_t i : {6, 7})
      error = std::max(error, std::abs(again.final_state[i] - held.final_state[i]));
    for (const Column& column : columns)
      for (std::size_t i = 1; i + 1 < rows.size(); ++i)
        difference +=
            std::abs(column.values[i + 1] - 2.0 * column.values[i] + column.values[i - 1]);
    const double bound = horizon / p.robot->rotor_inertia * step * difference / 8.0;
    std::printf("  logged every %.0f us: rotors off by %.2e rad, at most %.1e\n", 1e6 * step, error,
                bound);
    EXPECT_LT(error, bound);
    errors.push_back(error);
    ends.push_back(again.final_state);
  }
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) EXPECT_LT(errors[i + 1], 0.35 * errors[i]);
  // Extrapolated to h = 0 it is the motion itself, but for where in its row the slope jumps.
  for (const std::size_t i : {0, 1, 4, 6, 7})
    EXPECT_NEAR((4.0 * ends[2][i] - ends[1][i]) / 3.0, held.final_state[i], 0.3 * errors.back());
}

// Half the torque is a motor that gives half of it.
TEST(RecordedTorque, ScaledIsAnotherGainOfItsMotor) {
  const Parameters<double> p = DrivenParameters(0.01);
  const Column ripple = ColumnOf(0.007, 0.5, [](double t) { return 0.4 * std::sin(31.0 * t); });
  std::vector<DrivenInput> inputs = {ripple.Of(InputKind::kHipTorque1),
                                     ripple.Of(InputKind::kHipTorque2)};
  std::array<EffectSetting, 1> effects = {EffectSetting::Null(*FindEffect("motor_gain_2"))};
  SimulationRequest q = Drop(p, 0.15);
  effects[0].values[0] = -0.25;
  const std::vector<D> by_gain = {D::EffectParameter(0, 0)}, by_scale = {D::InputScale(1)};
  q.inputs = inputs;
  q.effects = effects;
  q.directions = by_gain;
  const Trajectory gain = Simulate(q);
  inputs[1].scale = 0.75;
  q.effects = {};
  q.directions = by_scale;
  const Trajectory scale = Simulate(q);
  ASSERT_EQ(gain.outcome, Outcome::kCompleted);
  for (std::size_t i = 0; i < gain.final_state.size(); ++i) {
    EXPECT_NEAR(scale.final_state[i], gain.final_state[i], 1e-9) << i;
    EXPECT_NEAR(scale.final_sensitivities[i], gain.final_sensitivities[i],
                1e-7 * (1.0 + std::abs(gain.final_sensitivities[i])))
        << i;
  }
}

// A force of the log acts at the centre of mass, along the axes of the world on a slope too.
TEST(RecordedForce, PushesARobotInTheAir) {
  Parameters<double> p = RobotParametersFor(2);
  p.slope = 0.1;
  SimulationRequest q = RobotDrop(p, {0.0, 2.0, 0.3, 0.0, 0.05, 0.4}, 0.2);
  const Column gust{{0.0, 0.1}, {6.0, 0.0}};
  const std::vector<DrivenInput> inputs = {gust.Of(InputKind::kBodyForceX),
                                           gust.Of(InputKind::kBodyForceY, true)};
  const Trajectory still = Simulate(q);
  q.inputs = inputs;
  const Trajectory pushed = Simulate(q);
  EXPECT_NEAR(pushed.final_state[2] - still.final_state[2], 0.5 * 6.0 * 0.1 / p.m, 1e-11);
  EXPECT_NEAR(pushed.final_state[3] - still.final_state[3], 6.0 * 0.1 / p.m, 1e-11);
  EXPECT_NEAR(pushed.final_state[4], 0.05 + 0.4 * 0.2, 1e-11);
}

// ---- derivatives -----------------------------------------------------------------------------

struct DrivenRobot {
  std::string name;
  bool torque_1, torque_2, force;
  double leg_mass, lag;
};
void PrintTo(const DrivenRobot& d, std::ostream* out) { *out << d.name; }

class DrivenRobotGradient : public ::testing::TestWithParam<DrivenRobot> {};

TEST_P(DrivenRobotGradient, AgreesWithDifferencesLinearAndHeld) {
  const DrivenRobot& of = GetParam();
  Parameters<double> p = DrivenParameters(of.leg_mass);
  p.robot->rotor_inertia = 4e-3;  // slower than a real one: fewer steps
  p.robot->torque_limit = 4.0;
  p.robot->angle = {0.45, 0.5};
  const double step = 0.009, delay = 0.0013;
  const auto torque = [](double t) { return 0.8 * std::sin(31.0 * t) - 0.3; };
  const auto angle = [](double t) { return 0.45 + 0.1 * std::sin(17.0 * t); };
  const auto gust = [](double t) { return 3.0 * std::cos(13.0 * t); };
  for (const bool held : {false, true}) {
    SCOPED_TRACE(held ? "held" : "linear");
    std::vector<Column> columns;
    std::vector<InputKind> kinds;
    for (int motor = 0; motor < 2; ++motor) {
      const bool told = motor == 0 ? of.torque_1 : of.torque_2;
      columns.push_back(told ? ColumnOf(step, 0.3, torque) : ColumnOf(step, 0.3, angle));
      kinds.push_back(OfMotor(told ? InputKind::kHipTorque1 : InputKind::kLegAngle1, motor));
    }
    if (of.force) {
      columns.push_back(ColumnOf(0.011, 0.3, gust));
      kinds.push_back(InputKind::kBodyForceX);
      columns.push_back(columns.back());
      kinds.push_back(InputKind::kBodyForceY);
    }
    std::vector<DrivenInput> inputs;
    std::vector<double> knots;
    std::vector<D> directions = {D::Parameter(ParameterId::kE),
                                 D::Parameter(ParameterId::kMotorKp),
                                 D::Parameter(ParameterId::kMotorKd),
                                 D::Parameter(ParameterId::kRotorInertia),
                                 D::InitialState(1),
                                 D::InitialState(4)};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      inputs.push_back(columns[i].Of(kinds[i], held, delay));
      for (const double t : columns[i].times) knots.push_back(t + delay);
      directions.push_back(D::InputDelay(static_cast<int>(i)));
      directions.push_back(D::InputScale(static_cast<int>(i)));
    }
    std::array<EffectSetting, 1> effects = {EffectSetting::Null(*FindEffect("motor_lag"))};
    effects[0].values[0] = of.lag;
    SimulationRequest q = Drop(p, 0.12);
    q.inputs = inputs;
    q.effects = effects;
    EXPECT_GT(ExpectRobotExact(q, knots, directions), 20);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, DrivenRobotGradient,
                         ::testing::Values(DrivenRobot{"torques", true, true, false, 0.0, 0.0},
                                           DrivenRobot{"references", false, false, false, 0.0, 0.0},
                                           DrivenRobot{"mixed", true, false, true, 0.0, 0.0},
                                           DrivenRobot{"heavy_legs", false, true, true, 0.01, 0.0},
                                           DrivenRobot{"lag", true, false, false, 0.0, 2e-3},
                                           DrivenRobot{"short_lag", true, false, false, 0.01,
                                                       5e-6}),
                         [](const auto& info) { return info.param.name; });

// The derivative by a delay that all torques share is the sum of those by each.
TEST(RecordedTorque, IsLateAsItsEffectSays) {
  const Parameters<double> p = DrivenParameters();
  const Column ripple = ColumnOf(0.007, 0.5, [](double t) { return 0.4 * std::sin(31.0 * t); });
  const std::vector<DrivenInput> inputs = {ripple.Of(InputKind::kHipTorque1, false, 0.002),
                                           ripple.Of(InputKind::kHipTorque2, false, 0.002)};
  const std::array effects = {EffectSetting::Null(*FindEffect("torque_input_delay"))};
  const std::vector<D> directions = {D::EffectParameter(0, 0), D::InputDelay(0), D::InputDelay(1)};
  SimulationRequest q = Drop(p, 0.15);
  q.inputs = inputs;
  q.effects = effects;
  q.directions = directions;
  const Trajectory run = Simulate(q);
  ASSERT_EQ(run.outcome, Outcome::kCompleted);
  for (std::size_t i = 0; i < run.final_state.size(); ++i) {
    const double* d = run.final_sensitivities.data() + 3 * i;
    EXPECT_NEAR(d[0], d[1] + d[2], 1e-9 * (1.0 + std::abs(d[1]) + std::abs(d[2]))) << i;
  }
}

}  // namespace
}  // namespace hoplab
