// What a log drives (M50 to M55): derivatives against Richardson differences through held and
// linear inputs, by every parameter, delay and scale; closed forms; what a corner and a jump do.

#include "model/inputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"
#include "tests/support/row_gradient.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// A column logged every few milliseconds, with a delay that lies on none of its rows.
struct Column {
  std::vector<double> times, values;
  template <class F>
  Column(double step, double end, const F& f) {
    for (int i = -2; i * step < end; ++i) {
      times.push_back(i * step);
      values.push_back(f(i * step));
    }
  }
  DrivenInput Of(InputKind kind, bool held) const {
    return {.kind = kind, .times = times, .values = values, .held = held, .delay = 0.0013};
  }
};

// A motor's ripple, and an angle that swings back before each touch-down.
Column Ripple(double size) {
  return {0.007, 2.0, [=](double t) { return size * (0.6 + std::sin(31.0 * t)); }};
}
Column Swing(double mean, double size) {
  return {0.009, 2.0, [=](double t) { return mean + size * std::sin(17.0 * t); }};
}
Column Gust(double size) {
  return {0.011, 2.0, [=](double t) { return size * std::cos(13.0 * t); }};
}

struct Driven {
  std::string name;
  SimulationRequest request;
  std::vector<std::pair<InputKind, Column>> columns;
};
void PrintTo(const Driven& d, std::ostream* out) { *out << d.name; }

std::vector<Driven> DrivenCases() {
  std::vector<Driven> cases;
  const auto add = [&](const std::string& name, const SimulationRequest& q,
                       std::vector<std::pair<InputKind, Column>> columns) {
    cases.push_back({name, q, std::move(columns)});
  };
  for (Law law : kCLegLaws) {
    const std::string name(NameOf(law));
    add(name + "_torque", ThickLegRequest(law), {{InputKind::kHipTorque, Ripple(0.4)}});
    add(name + "_force", ThickLegRequest(law),
        {{InputKind::kBodyForceX, Gust(0.8)}, {InputKind::kBodyForceY, Gust(0.5)}});
  }
  const SimulationRequest c_leg = ThickLegRequest(Law::kLargeDeflection);
  const double angle = c_leg.parameters.theta_td;
  add("c_leg_angle", c_leg, {{InputKind::kLegAngle, Swing(angle, 0.06)}});
  add("c_leg_all", c_leg,
      {{InputKind::kHipTorque, Ripple(0.3)},
       {InputKind::kLegAngle, Swing(angle, 0.05)},
       {InputKind::kBodyForceX, Gust(0.4)},
       {InputKind::kBodyForceY, Gust(0.3)}});
  SimulationRequest straight = SteadyStraightLeg();
  straight.initial[3] = -0.1;
  straight.parameters.d = 60.0;
  add("straight_leg_torque", straight, {{InputKind::kHipTorque, Ripple(6.0)}});
  add("straight_leg_angle", straight,
      {{InputKind::kLegAngle, Swing(straight.parameters.theta_td, 0.03)}});
  add("ball_force", BallRequest(),
      {{InputKind::kBodyForceX, Gust(0.5)}, {InputKind::kBodyForceY, Gust(0.5)}});
  return cases;
}

class DrivenGradient : public ::testing::TestWithParam<Driven> {};

TEST_P(DrivenGradient, AgreesWithDifferencesLinearAndHeld) {
  for (const bool held : {false, true}) {
    SCOPED_TRACE(held ? "held" : "linear");
    SimulationRequest q = GetParam().request;
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    std::vector<DrivenInput> inputs;
    // An angle that jumps into the ground is another sequence of events; here it only turns.
    for (const auto& [kind, column] : GetParam().columns) inputs.push_back(column.Of(kind, held));
    q.inputs = inputs;
    ExpectExact(q, Directions(q));
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, DrivenGradient, ::testing::ValuesIn(DrivenCases()),
                         [](const auto& info) { return info.param.name; });

// ---- closed forms

// A ball under a force that is held and jumps at 0.1 s + delay: two parabolas.
TEST(DrivenBall, FliesTwoParabolasUnderAForceThatJumps) {
  SimulationRequest q = BallRequest();
  q.initial = {0.0, 5.0, 1.0, 0.0};
  q.parameters.m = 2.0;
  q.parameters.g = 9.81;
  q.horizon = 0.3;
  const std::vector<double> times = {0.0, 0.1}, values = {4.0, -6.0};
  const std::vector<DrivenInput> inputs = {{.kind = InputKind::kBodyForceX,
                                            .times = times,
                                            .values = values,
                                            .held = true,
                                            .delay = 0.02,
                                            .scale = 0.5}};
  const std::vector<D> directions = {D::InputDelay(0), D::InputScale(0)};
  q.inputs = inputs;
  q.directions = directions;
  const Trajectory run = Simulate(q);
  ASSERT_EQ(run.outcome, Outcome::kCompleted);
  // 1 m/s^2 until 0.12 s, then -1.5 m/s^2.
  const double before = 0.12, after = 0.18;
  EXPECT_NEAR(run.final_state[2], 1.0 + 1.0 * before - 1.5 * after, 1e-12);
  EXPECT_NEAR(run.final_state[0],
              0.3 + 0.5 * before * before + before * after - 0.75 * after * after, 1e-12);
  EXPECT_NEAR(run.final_sensitivities[2 * 2 + 0], 1.0 + 1.5, 1e-10);
  EXPECT_NEAR(run.final_sensitivities[2 * 2 + 1], 2.0 * (before - 1.5 * after), 1e-10);
  EXPECT_NEAR(run.final_sensitivities[0 * 2 + 0], (1.0 + 1.5) * after, 1e-10);
}

TEST(DrivenBall, GainsTheIntegralOfAForceThatIsLinearBetweenItsRows) {
  SimulationRequest q = BallRequest();
  q.initial = {0.0, 5.0, 0.0, 0.0};
  q.parameters.m = 2.0;
  q.horizon = 0.4;
  // Up to 4 N at 0.1 s, down to 0 at 0.3 s, constant after.
  const std::vector<double> times = {0.0, 0.1, 0.3}, values = {0.0, 4.0, 0.0};
  const std::vector<DrivenInput> inputs = {
      {.kind = InputKind::kBodyForceX, .times = times, .values = values}};
  q.inputs = inputs;
  const Trajectory run = Simulate(q);
  EXPECT_NEAR(run.final_state[2], 0.5 * 0.3 * 4.0 / 2.0, 1e-12);
}

// The log of what the controller gave, finely enough, drives the leg as the controller did.
TEST(DrivenLeg, FollowsTheLogOfItsOwnController) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.kp = 0.6;
  q.parameters.v_des = 1.6;
  q.max_hops = 0;
  q.horizon = 0.7;
  std::vector<double> rows;
  for (int i = 0; i <= 7000; ++i) rows.push_back(1e-4 * i);
  const std::vector<Channel> channels = {Channel::kBodyX, Channel::kBodyY, Channel::kHipTorque};
  q.row_times = rows;
  q.channels = channels;
  const Trajectory controlled = Simulate(q);
  ASSERT_TRUE(IsComplete(controlled.outcome));
  std::vector<double> torque;
  for (std::size_t i = 0; i < rows.size(); ++i) torque.push_back(controlled.samples[3 * i + 2]);
  const std::vector<DrivenInput> inputs = {
      {.kind = InputKind::kHipTorque, .times = rows, .values = torque}};
  q.parameters.kp = 0.0;
  q.inputs = inputs;
  const Trajectory driven = Simulate(q);
  // At a touch-down the log rises within one row and the controller at once: 1e-4 s of it.
  for (std::size_t i = 0; i + 1 < rows.size(); i += 100)
    EXPECT_NEAR(driven.samples[3 * i], controlled.samples[3 * i], 2e-4) << rows[i];
}

TEST(DrivenLeg, WithoutInputsRunsAsItDidBitForBit) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const Trajectory plain = Simulate(q);
  const std::vector<double> times = {0.0, 1.0}, values = {0.0, 0.0};
  const std::vector<DrivenInput> none;
  q.inputs = none;
  EXPECT_EQ(Simulate(q).final_state, plain.final_state);
  const std::vector<double> angle = {q.parameters.theta_td};
  q.touchdown_angles = angle;
  EXPECT_EQ(Simulate(q).final_state, plain.final_state);
}

// ---- angles

TEST(TouchdownAngles, AreThoseOfTheListOneAfterTheOtherAndTheLastOneStays) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.max_hops = 3;
  q.horizon = 3.0;
  const std::vector<double> angles = {Degrees(24.0), Degrees(21.0)};
  q.touchdown_angles = angles;
  const Trajectory run = Simulate(q);
  std::vector<double> heights;
  for (const Event& e : run.events)
    if (e.kind == EventKind::kTouchdown) heights.push_back(e.y);
  ASSERT_EQ(heights.size(), 3u);
  const double r = q.parameters.r;
  EXPECT_NEAR(heights[0], r * (1 + std::cos(angles[0])), 1e-11);
  EXPECT_NEAR(heights[1], r * (1 + std::cos(angles[1])), 1e-11);
  EXPECT_NEAR(heights[2], r * (1 + std::cos(angles[1])), 1e-11);
}

TEST(TouchdownAngles, AreDifferentiatedEachByItself) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  const std::vector<double> angles = {Degrees(24.0), Degrees(21.0)};
  q.touchdown_angles = angles;
  ExpectExact(q, {D::TouchdownAngle(0), D::TouchdownAngle(1), D::Parameter(ParameterId::kE)});
}

TEST(DrivenAngle, IsReadAtTheInstantOfTouchdown) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  const Column swing = Swing(q.parameters.theta_td, 0.06);
  const std::vector<DrivenInput> inputs = {swing.Of(InputKind::kLegAngle, false)};
  q.inputs = inputs;
  const Trajectory run = Simulate(q);
  InputSignal<double> signal(inputs[0], inputs[0].delay, 1.0);
  int touchdowns = 0;
  for (const Event& e : run.events) {
    if (e.kind != EventKind::kTouchdown) continue;
    signal.Seek(e.time);
    EXPECT_NEAR(e.y, q.parameters.r * (1 + std::cos(signal.At(e.time))), 1e-10);
    ++touchdowns;
  }
  EXPECT_GT(touchdowns, 0);
}

// A command that jumps into the ground: the leg meets it on its way, at the instant of the jump.
TEST(DrivenAngle, ThatJumpsIntoTheGroundLandsWhereItMeetsIt) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  const double r = q.parameters.r;
  q.initial = {0.0, r * (1 + std::cos(Degrees(30.0))) + 0.004, 1.0, -0.4};
  const std::vector<double> times = {0.0, 0.005}, values = {Degrees(60.0), Degrees(20.0)};
  std::vector<DrivenInput> inputs = {{.kind = InputKind::kLegAngle,
                                      .times = times,
                                      .values = values,
                                      .held = true,
                                      .delay = 0.0004}};
  q.inputs = inputs;
  q.max_hops = 1;
  q.horizon = 0.5;
  const std::vector<D> directions = {D::InputDelay(0), D::InitialState(1), D::InitialState(3),
                                     D::Parameter(ParameterId::kE), D::Parameter(ParameterId::kR)};
  q.directions = directions;
  const Trajectory run = Simulate(q);
  ASSERT_FALSE(run.events.empty());
  const Event& landing = run.events.front();
  EXPECT_EQ(landing.kind, EventKind::kTouchdown);
  EXPECT_NEAR(landing.time, 0.0054, 1e-12);
  EXPECT_NEAR(run.event_time_sensitivities[0], 1.0, 1e-12);  // it moves with the delay
  const double t = landing.time;
  EXPECT_NEAR(landing.y, q.initial[1] - 0.4 * t - 0.5 * 9.81 * t * t, 1e-9);
  for (const ColumnCheck& check : CheckGradient(q, run)) EXPECT_EQ(Complaint(check), "");
}

}  // namespace
}  // namespace hoplab
