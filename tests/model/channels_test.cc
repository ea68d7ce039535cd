// What channels tell (M54, M55), and the clocks that stamp them.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

TEST(Accelerations, AreTheRateOfTheVelocityAndTheImuReadsThemWithoutGravity) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.max_hops = 0;
  q.horizon = 0.5;
  std::vector<double> rows;
  for (int i = 0; i <= 5000; ++i) rows.push_back(1e-4 * i);
  const std::vector<Channel> channels = {Channel::kBodyVx, Channel::kBodyVy, Channel::kBodyAx,
                                         Channel::kBodyAy, Channel::kImuAx,  Channel::kImuAy,
                                         Channel::kContact};
  q.row_times = rows;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  const auto at = [&](std::size_t row, std::size_t c) { return run.samples[7 * row + c]; };
  int in_stance = 0;
  for (std::size_t i = 1; i + 1 < rows.size(); i += 7) {
    if (at(i - 1, 6) != at(i + 1, 6)) continue;
    for (std::size_t c = 0; c < 2; ++c) {
      const double slope = (at(i + 1, c) - at(i - 1, c)) / 2e-4;
      EXPECT_NEAR(at(i, 2 + c), slope, 2e-3 * std::max(1.0, std::abs(slope))) << rows[i];
    }
    EXPECT_NEAR(at(i, 5), at(i, 3) + q.parameters.g, 1e-12);
    EXPECT_EQ(at(i, 4), at(i, 2));
    if (at(i, 6) == 0.0) {
      EXPECT_NEAR(at(i, 5), 0.0, 1e-12);  // nothing but gravity in flight
    }
    in_stance += at(i, 6) > 0.5 ? 1 : 0;
  }
  EXPECT_GT(in_stance, 20);
}

TEST(ContactPlace, IsWhereTheLegLandsAndStaysUnderIt) {
  SimulationRequest q = SteadyStraightLeg();
  q.initial[3] = -0.1;
  q.max_hops = 0;
  q.horizon = 0.4;
  std::vector<double> rows;
  for (int i = 0; i <= 400; ++i) rows.push_back(1e-3 * i);
  const std::vector<Channel> channels = {Channel::kBodyX, Channel::kContactX, Channel::kContact};
  q.row_times = rows;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  double place = std::nan("");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double x = run.samples[3 * i], contact = run.samples[3 * i + 1];
    if (run.samples[3 * i + 2] == 0.0) {
      EXPECT_NEAR(contact - x, q.parameters.l0 * std::sin(q.parameters.theta_td), 1e-12);
      place = std::nan("");
    } else {
      if (std::isnan(place)) place = contact;
      EXPECT_NEAR(contact, place, 1e-12);  // a foot that holds
    }
  }
}

TEST(Clocks, ShiftTheChannelsTheyStampAndAreDifferentiated) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.max_hops = 0;
  q.horizon = 0.5;
  const std::vector<double> rows = {0.01, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3};
  const std::vector<Channel> channels = {Channel::kBodyX, Channel::kBodyY};
  q.row_times = rows;
  q.channels = channels;
  const std::vector<double> offsets = {0.02};
  const std::vector<int> of_channels = {-1, 0};
  q.clock_offsets = offsets;
  q.channel_clocks = of_channels;
  const std::vector<D> directions = {D::ClockOffset(0), D::Parameter(ParameterId::kE)};
  q.directions = directions;
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.rows_in_run, 7);
  SimulationRequest plain = q;
  plain.clock_offsets = {};
  plain.channel_clocks = {};
  plain.directions = {};
  const Trajectory now = Simulate(plain);
  std::vector<double> later = rows;
  for (double& t : later) t += 0.02;
  plain.row_times = later;
  const Trajectory then = Simulate(plain);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(run.samples[2 * i], now.samples[2 * i], 1e-11);
    EXPECT_NEAR(run.samples[2 * i + 1], then.samples[2 * i + 1], 1e-11);
  }
  for (const ColumnCheck& check : CheckGradient(q, run)) EXPECT_EQ(Complaint(check), "");
}

TEST(VerticalGuide, HoldsTheBodyAlongTheGround) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.parameters.on_guide = true;
  q.initial = {0.3, 0.25, 0.0, 0.0};
  q.max_hops = 0;
  q.horizon = 0.6;
  const Trajectory run = Simulate(q);
  EXPECT_GT(run.hops, 0);
  EXPECT_EQ(run.final_state[0], 0.3);
  EXPECT_EQ(run.final_state[2], 0.0);
}

}  // namespace
}  // namespace hoplab
