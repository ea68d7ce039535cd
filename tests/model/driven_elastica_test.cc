// An elastica whose hip is driven: the torque bends the leg without being asked to (M120).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "model/effects/effect.h"
#include "tests/support/effect_requests.h"
#include "tests/support/elastica.h"

namespace hoplab {
namespace {

using namespace testing;

// A leg that only bends, under a controller that pushes; the load on a stiffer one is less.
SimulationRequest DrivenHop(double stiffer = 1.0) {
  SimulationRequest q = ThickLegRequest(Law::kElastica);
  q.parameters.d = 0.0;
  q.parameters.A = 1e3;
  q.parameters.G = 1e18;
  q.parameters.E *= stiffer;
  q.parameters.kp = 1.0;
  q.parameters.v_des = 1.5;
  q.parameters.theta_td = Degrees(30.0);
  q.initial = {0.0, 0.25, 0.7, -0.1};
  return q;
}

// How far the chords of a rolling stance are from those of the held elastica under the same forces,
// which it would have with `share` of the torque [m].
struct Chords {
  double worst = 0.0, bent_by_torque = 0.0;
  int rows = 0;
};
Chords MissesOf(SimulationRequest q, double share) {
  const Trajectory whole = Simulate(q);
  const std::vector<double> times = EvenTimes(whole.end_time, 300);
  constexpr std::array kSeen = {Channel::kBodyX,        Channel::kBodyY,    Channel::kContactX,
                                Channel::kContactArc,   Channel::kContact,  Channel::kGroundForceX,
                                Channel::kGroundForceY, Channel::kHipTorque};
  q.row_times = times;
  q.channels = kSeen;
  const Trajectory run = Simulate(q);
  Chords out;
  for (std::size_t i = 0; i < run.samples.size() / kSeen.size(); ++i) {
    const double* row = &run.samples[kSeen.size() * i];
    const double arc = row[3];
    if (row[4] != 1.0 || !(arc < std::numbers::pi)) continue;
    const double u = row[2] - row[0], y = row[1], l = std::hypot(u, y);
    const double along = (y * row[6] - u * row[5]) / l, across = row[7] / l;
    if (!(along > 0.0)) continue;
    const Parameters<double>& p = q.parameters;
    const double EI = p.E * p.I;
    const double held = SolveHeldArc(arc, p.r, EI, along, share * across).chord;
    out.worst = std::max(out.worst, std::abs(held - l));
    out.bent_by_torque =
        std::max(out.bent_by_torque, std::abs(held - SolvePressedArc(arc, p.r, EI, along).chord));
    ++out.rows;
  }
  return out;
}

// What it does is there for any load, to second order of the torque.
TEST(DrivenElastica, IsBentByItsTorqueAsTheShotElastica) {
  struct Case {
    double stiffer, bound;
  };
  for (const Case c : {Case{1.0, 2e-4}, Case{16.0, 2e-6}}) {
    const Chords of = MissesOf(DrivenHop(c.stiffer), 1.0);
    std::printf("  the torque moves the chord by %.2g mm, of which %.2g um are off, in %d rows\n",
                1e3 * of.bent_by_torque, 1e6 * of.worst, of.rows);
    EXPECT_GT(of.rows, 8);
    EXPECT_GT(of.bent_by_torque, 1e-4);
    EXPECT_LT(of.worst, c.bound * of.bent_by_torque);
  }
}

// A log, an amplifier's offset: they bend it as a controller does.
TEST(DrivenElastica, IsBentByWhateverTorqueActs) {
  const std::vector<double> rows = {0.0, 1.0}, torque = {0.5, 0.5};
  const std::array inputs = {
      DrivenInput{.kind = InputKind::kHipTorque, .times = rows, .values = torque}};
  const std::array offset = {Setting("torque_bias", 0.5)};
  SimulationRequest logged = DrivenHop(4.0);
  logged.parameters.kp = 0.0;
  SimulationRequest biased = logged;
  logged.inputs = inputs;
  biased.effects = offset;
  for (const SimulationRequest& q : {logged, biased}) {
    const Chords of = MissesOf(q, 1.0);
    EXPECT_GT(of.rows, 8);
    EXPECT_GT(of.bent_by_torque, 1e-4);
    EXPECT_LT(of.worst, 1e-3 * of.bent_by_torque);
  }
}

TEST(DrivenElastica, AShareThatIsStatedTakesItsPlace) {
  SimulationRequest q = DrivenHop();
  const std::array none = {Setting("torque_bending", 0.0)}, half = {Setting("torque_bending", 0.5)},
                   all = {Setting("torque_bending", 1.0)};
  q.effects = none;
  EXPECT_LT(MissesOf(q, 0.0).worst, 1e-9);
  q.effects = half;
  const Chords of = MissesOf(q, 0.5);
  EXPECT_LT(of.worst, 2e-4 * of.bent_by_torque);
  q.effects = all;
  const Trajectory stated = Simulate(q);
  q.effects = {};
  EXPECT_EQ(stated.final_state, Simulate(q).final_state);
}

TEST(DrivenElastica, OtherLawsAreNotBentUnlessTheyAreTold) {
  for (const Law law : {Law::kLargeDeflection, Law::kConsistent}) {
    SimulationRequest q = DrivenHop();
    q.law = law;
    const std::array none = {Setting("torque_bending", 0.0)};
    const Trajectory plain = Simulate(q);
    q.effects = none;
    const Trajectory stated = Simulate(q);
    for (std::size_t i = 0; i < plain.final_state.size(); ++i)
      EXPECT_NEAR(plain.final_state[i], stated.final_state[i], 1e-7) << i;
  }
}

}  // namespace
}  // namespace hoplab
