#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gradient_check.h"
#include "tests/support/matrix_near.h"
#include "tests/support/toe_mass.h"

// M47: a leg that starts at another angle than it is placed at.

namespace hoplab {
namespace {

using namespace testing;

const double kStartAngle = Degrees(32.0);

SimulationRequest SomeHops(Law law, int hops) {
  SimulationRequest q = ToeMassRequest(law);
  q.parameters.m_toe = 0.0;
  q.horizon = 5.0;
  q.max_hops = hops;
  return q;
}

const Event& Last(const Trajectory& run, EventKind kind) {
  const Event* last = nullptr;
  for (const Event& event : run.events) last = event.kind == kind ? &event : last;
  return *last;
}

TEST(StartAngle, IsThatOfTheFirstTouchdown) {
  for (const Law law : kLegLaws) {
    SimulationRequest whole = SomeHops(law, 2);
    const double start_angle = whole.parameters.theta_td + Degrees(4.0);
    whole.parameters.start_angle = start_angle;
    const Trajectory run = Simulate(whole);
    ASSERT_EQ(run.outcome, Outcome::kHopLimit) << NameOf(law);

    // The same in two runs: as set by hand to the first apex, and from there placed.
    SimulationRequest set = SomeHops(law, 1);
    set.parameters.theta_td = start_angle;
    const Trajectory first = Simulate(set);
    const Event& apex = Last(first, EventKind::kApex);
    SimulationRequest placed = SomeHops(law, 1);
    placed.initial = {apex.x, apex.y, apex.vx, 0.0};
    const Trajectory second = Simulate(placed);
    const Event &end = Last(run, EventKind::kApex), &then = Last(second, EventKind::kApex);
    EXPECT_NEAR(end.time, apex.time + then.time, 1e-8) << NameOf(law);
    EXPECT_NEAR(end.x, then.x, 1e-8) << NameOf(law);
    EXPECT_NEAR(end.y, then.y, 1e-8) << NameOf(law);
    EXPECT_NEAR(end.vx, then.vx, 1e-8) << NameOf(law);
    // And it is another run than one at either angle.
    set.max_hops = 2;
    EXPECT_GT(std::abs(end.x - Last(Simulate(set), EventKind::kApex).x), 1e-3) << NameOf(law);
    placed = SomeHops(law, 2);
    EXPECT_GT(std::abs(end.x - Last(Simulate(placed), EventKind::kApex).x), 1e-3) << NameOf(law);
  }
}

TEST(StartAngle, OfThePlacedLegChangesNothing) {
  for (const double toe_mass : {0.0, 0.02}) {
    SimulationRequest q = SomeHops(Law::kThesis, 2);
    q.parameters.m_toe = toe_mass;
    const Trajectory without = Simulate(q);
    q.parameters.start_angle = q.parameters.theta_td;
    EXPECT_EQ(Simulate(q).final_state, without.final_state) << toe_mass;
  }
}

TEST(StartAngle, IsHeldByALegWithAToeMassTooAndPlacedThen) {
  SimulationRequest q = ToeMassRequest(Law::kLargeDeflection);
  q.parameters.start_angle = kStartAngle;
  q.horizon = 5.0;
  q.max_hops = 2;
  const Trajectory run = Simulate(q);
  ASSERT_EQ(run.outcome, Outcome::kHopLimit);
  std::vector<double> before;
  for (const Event& event : run.events) {
    if (event.kind == EventKind::kTouchdown) before.push_back(event.time - 1e-6);
  }
  ASSERT_EQ(before.size(), 2U);
  const Channel channels[] = {Channel::kLegAngle};
  q.row_times = before;
  q.channels = channels;
  const Trajectory seen = Simulate(q);
  EXPECT_NEAR(seen.samples[0], kStartAngle, 1e-9);
  EXPECT_NEAR(seen.samples[1], q.parameters.theta_td, Degrees(1.0));
}

TEST(StartAngle, DerivativesMatchDifferences) {
  SimulationRequest q = SomeHops(Law::kThesis, 2);
  q.parameters.start_angle = kStartAngle;
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  const std::vector<SensitivityDirection> directions = {
      SensitivityDirection::Parameter(ParameterId::kThetaTd),
      SensitivityDirection::Parameter(ParameterId::kE), SensitivityDirection::InitialState(2)};
  q.directions = directions;
  for (const ColumnCheck& check : CheckGradient(q)) EXPECT_EQ(Complaint(check), "") << check.what;
  // The angle of placement says nothing before the leg is placed.
  q.max_hops = 1;
  const Trajectory first = Simulate(q);
  for (std::size_t i = 0; i < first.final_state.size(); ++i)
    EXPECT_EQ(first.final_sensitivities[i * directions.size()], 0.0) << i;
}

}  // namespace
}  // namespace hoplab
