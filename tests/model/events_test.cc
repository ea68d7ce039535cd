#include <gtest/gtest.h>

#include <cmath>

#include "model/hybrid/engine.h"
#include "tests/support/clocks.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;

template <template <class> class System>
Trajectory RunSystem(double z0, double z1, double horizon) {
  System<double> system, values;
  System<Jet<1>> rates;
  RowReader<double> no_rows;
  Trajectory out;
  Engine<double> engine({system, values, rates}, {}, {.horizon = horizon}, no_rows, out);
  const double z[2] = {z0, z1};
  engine.Run(Mode::kRolling, z);
  return out;
}

Trajectory RunDip(double depth) {
  Dip<double> system, values;
  Dip<Jet<1>> rates;
  system.depth = values.depth = rates.depth = depth;
  RowReader<double> no_rows;
  Trajectory out;
  Engine<double> engine({system, values, rates}, {}, {.horizon = 2.0}, no_rows, out);
  const double z[2] = {0.0, 0.0};
  engine.Run(Mode::kRolling, z);
  return out;
}

TEST(SimultaneousEvents, AreFlaggedAndFireInTheOrderOfTheGuards) {
  const Trajectory run = RunSystem<TwoClocks>(1.0, 1.0, 2.0);
  ASSERT_EQ(EventNames(run), "rolling_to_toe liftoff");
  EXPECT_TRUE(run.has_simultaneous_events);
  EXPECT_TRUE(run.events[0].simultaneous);
  EXPECT_NEAR(run.events[0].time, 1.0, 1e-15);
  EXPECT_EQ(run.events[1].time, run.events[0].time);
}

TEST(SimultaneousEvents, AreNotFlaggedWhenTheyAreApart) {
  const Trajectory run = RunSystem<TwoClocks>(1.0, 1.00001, 2.0);
  ASSERT_EQ(EventNames(run), "rolling_to_toe liftoff");
  EXPECT_FALSE(run.has_simultaneous_events);
}

TEST(SimultaneousEvents, OfTwoInOneStepTheEarlierFires) {
  const Trajectory run = RunSystem<TwoClocks>(1.01, 1.0, 2.0);
  EXPECT_EQ(EventNames(run), "liftoff");
}

// Whichever of two is found first, the other one, then just below zero, fires with it.
TEST(SimultaneousEvents, NeitherOfTwoIsLost) {
  for (int k = 0; k < 200; ++k) {
    const double start = 0.3 + 0.001 * k, apart = 1e-16 * std::pow(10.0, 0.03 * k);
    for (const double sign : {1.0, -1.0}) {
      const Trajectory run = RunSystem<WoundClocks>(start, start + sign * apart, 0.24);
      ASSERT_EQ(run.outcome, Outcome::kCompleted) << start << ", " << apart;
      int of_leg[2] = {0, 0};
      for (const Event& e : run.events) ++of_leg[e.leg];
      EXPECT_EQ(of_leg[0], of_leg[1]) << start << ", " << apart;
      EXPECT_GE(of_leg[0], 1);
      for (const double z : run.final_state) EXPECT_GT(z, 0.0);
      for (std::size_t i = 1; i < run.events.size(); ++i)
        EXPECT_GE(run.events[i].time, run.events[i - 1].time);
    }
  }
}

// What is below zero by rounding, where it opens with no rate, has not come down.
TEST(SlowGuard, IsNotMetWhereItBegins) {
  const Trajectory run = RunSystem<OpensSlowly>(0.0, 0.0, 1.0);
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  EXPECT_EQ(EventNames(run), "");
}

TEST(SlowGuard, OfAFootThatStopsWithinItsFirstStepIsMet) {
  const Trajectory run = RunSystem<SlidesShortly>(0.0, 0.0, 1.0);
  ASSERT_EQ(EventNames(run), "stick");
  EXPECT_NEAR(run.events[0].time, 0.05, 1e-7);
}

TEST(Chattering, TwoEventsThatUndoEachOtherEndTheRun) {
  const Trajectory run = RunSystem<BackAndForth>(1.0, 0.0, 2.0);
  EXPECT_EQ(run.outcome, Outcome::kChattering);
  EXPECT_NEAR(run.end_time, 1.0, 1e-12);
}

TEST(ClosedGuard, OfLiftoffAfterAChangeOfStanceFiresWithTheChange) {
  using T = Jet<kNarrowJet>;
  LosesSupport<T> system;
  LosesSupport<double> values;
  LosesSupport<Jet<1>> rates;
  system.rate = Seeded<T>(1.0, 0, 1.0);
  RowReader<T> no_rows;
  Trajectory out;
  Engine<T> engine({system, values, rates}, {}, {.horizon = 2.0}, no_rows, out);
  const T z[2] = {T(1.0), T(0.5)};
  engine.Run(Mode::kRolling, z);
  ASSERT_EQ(EventNames(out), "rolling_to_toe liftoff");
  EXPECT_EQ(out.events[1].time, out.events[0].time);
  EXPECT_EQ(out.final_mode, Mode::kFlight);
  // t_e = 1/rate, for both.
  EXPECT_NEAR(engine.event_times()[0], -1.0, 1e-12);
  EXPECT_NEAR(engine.event_times()[kNarrowJet], -1.0, 1e-12);
}

TEST(GuardDip, InsideOneStepIsFound) {
  const Trajectory run = RunDip(1e-4);  // below zero for 0.02 s of a 2 s step
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_NEAR(run.events[0].time, 1.0 - 0.01, 1e-12);
}

TEST(GuardDip, ThatStaysAboveZeroIsReportedAsANearMiss) {
  const Trajectory run = RunDip(-1e-4);
  EXPECT_TRUE(run.events.empty());
  EXPECT_NEAR(run.nearest_miss, 1e-4, 1e-8);
}

TEST(EventLocation, TouchdownAndApexLieOnTheirGuards) {
  for (Law law : kCLegLaws) {
    const SimulationRequest q = ThickLegRequest(law);
    const Trajectory run = Simulate(q);
    ASSERT_EQ(EventNames(run), "touchdown liftoff apex");  // each once
    const double height = q.parameters.r * (1.0 + std::cos(q.parameters.theta_td));
    EXPECT_NEAR(run.events[0].y / height, 1.0, kEventResidual);
    EXPECT_NEAR(run.events[2].vy, 0.0, kEventResidual);
  }
}

TEST(EventLocation, LiftoffLiesWhereTheChordForceVanishes) {
  for (Law law : kCLegLaws) {
    SimulationRequest q = ThickLegRequest(law);
    const Trajectory hop = Simulate(q);
    q.horizon = hop.events[1].time - 1e-13;
    const std::array times = {q.horizon};
    const std::array channels = {Channel::kGroundForceX, Channel::kGroundForceY};
    q.row_times = times;
    q.channels = channels;
    const Trajectory run = Simulate(q);
    const double weight = q.parameters.m * q.parameters.g;
    // The last 1e-13 s bring 1e-13 s times the crossing rate of force.
    EXPECT_NEAR(std::hypot(run.samples[0], run.samples[1]) / weight, 0.0,
                kEventResidual + 1e-13 * std::abs(hop.events[1].crossing_rate));
  }
}

TEST(EventLocation, DoesNotDependOnTheSolverTolerance) {
  // On the same flow the located crossing is exact; what differs is the flow.
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.integrator.relative_tolerance = 1e-6;
  q.integrator.absolute_tolerance = 1e-7;
  const Trajectory run = Simulate(q);
  EXPECT_NEAR(run.events[2].vy, 0.0, kEventResidual);
  const double height = q.parameters.r * (1.0 + std::cos(q.parameters.theta_td));
  EXPECT_NEAR(run.events[0].y / height, 1.0, kEventResidual);
}

}  // namespace
}  // namespace hoplab
