// Closed forms of effects on a leg and its motor.
#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>

#include "model/effects/effect.h"
#include "tests/support/effect_requests.h"

namespace hoplab {
namespace {

using namespace testing;

TEST(HipViscousFriction, AnswersToTheRateOfTheLegAngle) {
  for (Law law : kAllLaws) {
    if (law == Law::kBall) continue;
    for (double theta : {30.0, 8.0, -10.0}) {
      SimulationRequest q = ExcitedRequest(law);
      q.parameters.kp = 0.0;
      if (law != Law::kStraightLeg) {
        q.parameters.theta_td = Degrees(theta);
        q.initial = {0.0, 0.25, 0.7, -0.1};
      }
      // Under elastica friction bends the leg (M94), whose own rate M93 leaves out.
      const double b_h = law == Law::kElastica ? 1e-7 : 0.02, step = 1e-4;
      const std::array effects = {Setting("hip_viscous_friction", b_h)};
      q.effects = effects;
      const Trajectory whole = Simulate(q);
      std::vector<double> times;
      for (double t : TimesClearOfEvents(whole)) {
        if (t < First(whole, EventKind::kTouchdown).time) continue;
        if (t > First(whole, EventKind::kLiftoff).time) break;
        for (double shift : {-2.0, -1.0, 0.0, 1.0, 2.0}) times.push_back(t + shift * step);
      }
      ASSERT_GE(times.size(), 10u);
      const std::array channels = {Channel::kHipTorque, Channel::kLegAngle};
      q.row_times = times;
      q.channels = channels;
      const Trajectory run = Simulate(q);
      const auto angle = [&](std::size_t row) { return run.samples[2 * row + 1]; };
      for (std::size_t i = 2; i < times.size(); i += 5) {
        const double rate =
            (8.0 * (angle(i + 1) - angle(i - 1)) - (angle(i + 2) - angle(i - 2))) / (12.0 * step);
        EXPECT_NEAR(run.samples[2 * i], b_h * rate, 1e-6 * b_h * (1.0 + std::abs(rate)))
            << NameOf(law) << ' ' << theta;
      }
    }
  }
}

// Where it does not bend the leg; where it does, hub_angle_test.cc.
TEST(HipViscousFriction, TakesFromTheBodyWhatItsTorqueDoesAcrossTheChord) {
  for (Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kStraightLeg}) {
    SimulationRequest q = ExcitedRequest(law);
    q.parameters.d = q.parameters.kp = 0.0;
    const double b_h = law == Law::kStraightLeg ? 5.0 : 0.02;
    const std::array effects = {Setting("hip_viscous_friction", b_h)};
    q.effects = effects;
    // Ended a moment before lift-off, so that what the leg holds counts.
    Trajectory run = Simulate(q);
    const double begin = First(run, EventKind::kTouchdown).time;
    q.horizon = First(run, EventKind::kLiftoff).time - 1e-12;
    using Rule = boost::math::quadrature::gauss<double, 20>;
    constexpr int kPanels = 40;
    std::vector<double> times;
    for (int panel = 0; panel < kPanels; ++panel) {
      const double half = 0.5 * (q.horizon - begin) / kPanels,
                   middle = begin + (2 * panel + 1) * half;
      for (std::size_t i = Rule::abscissa().size(); i-- > 0;)
        times.push_back(middle - half * Rule::abscissa()[i]);
      for (double x : Rule::abscissa()) times.push_back(middle + half * x);
    }
    const std::array channels = {Channel::kHipTorque, Channel::kBodyX,  Channel::kBodyY,
                                 Channel::kBodyVx,    Channel::kBodyVy, Channel::kContactX};
    q.row_times = times;
    q.channels = channels;
    run = Simulate(q);
    double lost = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const std::size_t place = i % 20, node = place < 10 ? 9 - place : place - 10;
      const double* row = &run.samples[channels.size() * i];
      const double torque = row[0], u = row[5] - row[1], y = row[2];
      const double turning = (y * row[3] + u * row[4]) / (u * u + y * y);
      lost -= 0.5 * (q.horizon - begin) / kPanels * Rule::weights()[node] * torque * turning;
    }
    const double start = Energy(q, Mode::kFlight, q.initial);
    EXPECT_GT(lost, 1e-5 * start) << NameOf(law);
    EXPECT_NEAR(start - EnergyAtEnd(q, run), lost, 1e-8 * start) << NameOf(law);
  }
}

TEST(HipFriction, HoldsBackALegThatGoesForward) {
  for (const char* name : {"hip_viscous_friction", "hip_coulomb_friction"}) {
    SimulationRequest q = ExcitedRequest(Law::kLargeDeflection);
    q.parameters.kp = 0.0;
    const std::vector<double> times = {0.14};
    const std::array channels = {Channel::kHipTorque};
    q.row_times = times;
    q.channels = channels;
    const std::array effects = {Setting(name, 0.01)};
    q.effects = effects;
    EXPECT_LT(Simulate(q).samples[0], -0.005) << name;
  }
}

TEST(LegHysteresis, TakesTheSameShareHoweverStiffTheLeg) {
  // A vertical hop of a straight leg: eta of the spring's work is lost going down, and coming up.
  SimulationRequest q = SteadyStraightLeg();
  q.parameters.theta_td = 0.0;
  q.initial = {0.0, 1.3, 0.0, -1.0};
  const std::array effects = {Setting("leg_hysteresis", 0.1)};
  q.effects = effects;
  for (double k : {1e4, 4e4}) {
    q.parameters.k = k;
    const Trajectory run = Simulate(q);
    const double down = Energy(q, Mode::kFlight, q.initial);
    const double up = EnergyAtEnd(q, run);
    // Greatest compression: (1 + eta) k D^2/2 = kinetic energy there + m g D, and back.
    const double m = 100.0, g = 10.0, eta = 0.1;
    const double e0 = down - m * g * 1.0, load = 0.5 * k * (1.0 + eta);
    const double D = (m * g + std::sqrt(m * g * m * g + 4.0 * load * e0)) / (2.0 * load);
    EXPECT_NEAR(down - up, 2.0 * eta * 0.5 * k * D * D, 2e-3 * (down - up)) << k;
  }
}

TEST(LegQuadraticDamping, IsADamperWhoseConstantIsItsSpeed) {
  const Effect& effect = *FindEffect("leg_quadratic_damping");
  const double d2 = 3.0;
  for (double w : {-0.7, 0.4}) {
    double force = 0.0;
    effect.hooks0.add_chord_force(
        &d2, {.elastic_force = 1.0, .stiffness = 1.0, .rate = w, .compression = 0.1}, force);
    EXPECT_DOUBLE_EQ(force, -d2 * std::abs(w) * w);
  }
}

TEST(TorqueLag, FollowsTheCommandByItsTimeConstant) {
  SimulationRequest q = ExcitedRequest(Law::kLargeDeflection);
  const double lag = 0.02, step = 1e-4;
  const std::array effects = {Setting("torque_lag", lag)};
  q.effects = effects;
  const double touchdown = First(Simulate(q), EventKind::kTouchdown).time;
  const std::vector<double> times = {touchdown + 1e-9, touchdown + 0.02 - step, touchdown + 0.02,
                                     touchdown + 0.02 + step};
  const std::array channels = {Channel::kHipTorque, Channel::kBodyVx};
  q.row_times = times;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  const auto torque = [&](int row) { return run.samples[2 * row]; };
  const auto command = [&](int row) {
    return q.parameters.kp * (q.parameters.v_des - run.samples[2 * row + 1]);
  };
  EXPECT_NEAR(torque(0), command(0), 1e-7);
  EXPECT_NEAR((torque(3) - torque(1)) / (2.0 * step), (command(2) - torque(2)) / lag, 1e-4);
  EXPECT_GT(std::abs(command(2) - torque(2)), 1e-3);
  EXPECT_EQ(run.final_state.size(), 5u);
}

TEST(TorqueLag, TooShortToIntegrateMeetsTheIntegratedOne) {
  for (Law law : {Law::kElastica, Law::kLargeDeflection, Law::kStraightLeg}) {
    SimulationRequest q = ExcitedRequest(law);
    std::array effects = {Setting("torque_lag", 0.9999e-5)};
    q.effects = effects;
    const Trajectory quick = Simulate(q);
    effects[0].values[0] = 1.0001e-5;
    const Trajectory integrated = Simulate(q);
    EXPECT_GT(integrated.steps, 5 * quick.steps);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(quick.final_state[i], integrated.final_state[i], 1e-8);
  }
}

// M52: the impulse that a lag takes from each step of a logged torque; of an elastica along the
// chord, too, since the torque bends it (M120).
TEST(TorqueLag, TakesOfEachStepOfALogWhatTheIntegratedOneDoes) {
  std::vector<double> rows, torque;
  for (int i = 0; i < 100; ++i) {
    rows.push_back(0.007 * i);
    torque.push_back(0.4 * (0.6 + std::sin(31.0 * rows.back())));
  }
  const std::array inputs = {
      DrivenInput{.kind = InputKind::kHipTorque, .times = rows, .values = torque, .held = true}};
  for (Law law : {Law::kElastica, Law::kLargeDeflection}) {
    SimulationRequest q = ThickLegRequest(law);
    q.parameters.kp = 0.0;
    q.inputs = inputs;
    const auto end = [&](double lag) {
      const std::array effects = {Setting("torque_lag", lag)};
      q.effects = effects;
      return Simulate(q).final_state;
    };
    const std::vector<double> none = end(0.0), quick = end(0.9999e-5), integrated = end(1.0001e-5);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(quick[i], integrated[i], 0.03 * std::abs(integrated[i] - none[i]) + 1e-9) << i;
  }
}

TEST(RestLengthStep, PutsInTheWorkOfItsPush) {
  SimulationRequest q = SteadyStraightLeg();
  const double dl = 0.01;
  const std::array effects = {Setting("rest_length_step", dl)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(EventNames(run), "touchdown max_compression liftoff apex");
  const Event& down = First(run, EventKind::kTouchdown);
  const Event& turn = First(run, EventKind::kMaxCompression);
  const double foot = down.x + q.parameters.l0 * std::sin(q.parameters.theta_td);
  const double ux = turn.x - foot, length = std::hypot(ux, turn.y);
  EXPECT_NEAR((ux * turn.vx + turn.y * turn.vy) / length, 0.0, 1e-11);
  const double deflection = q.parameters.l0 - length;
  const double work = q.parameters.k * (deflection * dl + 0.5 * dl * dl);
  EXPECT_NEAR(EnergyAtEnd(q, run) - Energy(q, Mode::kFlight, q.initial), work, 1e-9 * 1e3);
  // It is the unstretched leg that lands again.
  q.max_hops = 2;
  const Trajectory again = Simulate(q);
  int landings = 0;
  for (const Event& e : again.events) {
    if (e.kind != EventKind::kTouchdown) continue;
    ++landings;
    EXPECT_NEAR(e.y, q.parameters.l0 * std::cos(q.parameters.theta_td), 1e-12);
  }
  EXPECT_EQ(landings, 2);
}

TEST(TouchdownAngleSpeed, PlacesTheLegByTheSpeedOfTheMoment) {
  SimulationRequest q = ExcitedRequest(Law::kStraightLeg);
  const std::array effects = {Setting("touchdown_angle_speed", 0.1)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  const Event& e = First(run, EventKind::kTouchdown);
  const double theta = q.parameters.theta_td + 0.1 * (e.vx - 1.0);
  EXPECT_NEAR(e.y, q.parameters.l0 * std::cos(theta), 1e-12);
}

}  // namespace
}  // namespace hoplab
