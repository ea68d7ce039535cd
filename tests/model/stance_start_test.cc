// Runs that begin in stance (M53): as the run they were taken from, differentiated by their contact
// too.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/effect_requests.h"
#include "tests/support/row_gradient.h"

namespace hoplab {
namespace {

using namespace testing;

TEST(StanceStart, GoesOnAsTheRunItWasTakenFrom) {
  for (Law law : kCLegLaws) {
    SimulationRequest q = ThickLegRequest(law);
    q.max_hops = 0;
    q.horizon = 0.6;
    std::vector<double> rows;
    for (int i = 0; i <= 600; ++i) rows.push_back(1e-3 * i);
    const std::vector<Channel> channels = {Channel::kBodyX,  Channel::kBodyY,    Channel::kBodyVx,
                                           Channel::kBodyVy, Channel::kContactX, Channel::kContact};
    q.row_times = rows;
    q.channels = channels;
    const Trajectory whole = Simulate(q);
    ASSERT_TRUE(IsComplete(whole.outcome)) << NameOf(law);
    std::size_t row = 0;
    while (whole.samples[6 * row + 5] == 0.0) ++row;
    row += 5;  // well in stance
    ASSERT_EQ(whole.samples[6 * row + 5], 1.0);
    SimulationRequest from = q;
    from.start_mode = Mode::kStance;
    from.initial = {&whole.samples[6 * row], &whole.samples[6 * row + 5]};
    std::vector<double> later(rows.begin() + static_cast<long>(row), rows.end());
    for (double& t : later) t -= rows[row];
    from.row_times = later;
    from.horizon = later.back();
    const Trajectory part = Simulate(from);
    ASSERT_TRUE(IsComplete(part.outcome)) << NameOf(law);
    for (std::size_t i = 0; i < later.size(); i += 20)
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(part.samples[6 * i + c], whole.samples[6 * (row + i) + c], 1e-7)
            << NameOf(law) << " row " << i << " channel " << c;
  }
}

TEST(StanceStart, IsDifferentiatedByItsContactToo) {
  for (Law law : {Law::kLargeDeflection, Law::kConsistent, Law::kThesis}) {
    SCOPED_TRACE(NameOf(law));
    SimulationRequest q = ThickLegRequest(law);
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    q.start_mode = Mode::kRolling;
    const double theta = Degrees(20.0), r = q.parameters.r;
    q.initial = {0.0, r * (1 + std::cos(theta)) - 0.004, 0.9, -0.5, r * std::sin(theta)};
    ExpectExact(q, Directions(q));
  }
  SimulationRequest q = SteadyStraightLeg();
  q.start_mode = Mode::kStance;
  q.parameters.d = 60.0;
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  q.initial = {0.0, 0.9 * q.parameters.l0, 0.5, -0.3, 0.05 * q.parameters.l0};
  ExpectExact(q, Directions(q));
}

TEST(StanceStart, OfALegThatWouldPullLiftsOffAtOnce) {
  SimulationRequest q = SteadyStraightLeg();
  q.start_mode = Mode::kStance;
  q.initial = {0.0, 1.02 * q.parameters.l0, 0.2, 0.3, 0.0};
  const Trajectory run = Simulate(q);
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events.front().kind, EventKind::kLiftoff);
  EXPECT_EQ(run.events.front().time, 0.0);
}

}  // namespace
}  // namespace hoplab
