#include "app/records/trajectory_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "base/text.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using testing::Degrees;
using testing::StripLegRequest;

using Rows = std::vector<std::map<std::string, std::string>>;

Rows RowsOf(const SimulationRequest& request, double rate_hz) {
  CsvText csv(TrajectoryHeader({}));
  AddTrajectoryRows(request, rate_hz, {}, 0.0, csv);
  std::istringstream in(csv.text());
  const std::vector<std::string> names = TrajectoryHeader({});
  Rows rows;
  std::string line;
  for (std::getline(in, line); std::getline(in, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (const std::string& name : names) std::getline(cells, rows.back()[name], ',');
  }
  return rows;
}

double Number(const std::map<std::string, std::string>& row, const std::string& name) {
  return ParseDouble(row.at(name)).value_or(std::nan(""));
}

// The longest run of rows in stance has to have this many.
constexpr int kEnoughRows = 20;

TEST(TrajectoryTables, ARollingLegLaysItsArcOnTheGround) {
  // No slip: contact - r phi is where it was at touch-down, whatever the load (M8, M11).
  for (const Law law : {Law::kConsistent, Law::kLargeDeflection}) {
    SimulationRequest request = StripLegRequest(law, Degrees(30.0));
    request.parameters.kp = 2.0;  // with a hip torque, the force does not point to the hip
    request.parameters.v_des = 2.0;
    const Trajectory run = Simulate(request);
    ASSERT_EQ(run.events.at(0).kind, EventKind::kTouchdown);
    const double theta = request.parameters.theta_td, r = request.parameters.r;
    const double x0 = run.events[0].x + r * std::sin(theta) - r * (std::numbers::pi - theta);
    int seen = 0;
    for (const auto& row : RowsOf(request, 1000.0)) {
      if (Number(row, "time_s") > run.segments.at(1).end) break;
      if (row.at("mode") != "rolling") continue;
      EXPECT_NEAR(Number(row, "contact_x_m") - r * Number(row, "contact_arc_rad"), x0, 1e-9);
      EXPECT_NEAR(Number(row, "contact_y_m"), 0.0, 1e-9);
      ++seen;
    }
    EXPECT_GT(seen, kEnoughRows) << NameOf(law);
  }
}

TEST(TrajectoryTables, AStraightLegStandsOnOnePointAndHasNoArc) {
  const SimulationRequest request = testing::SteadyStraightLeg();
  const Trajectory run = Simulate(request);
  const double foot =
      run.events.at(0).x + request.parameters.l0 * std::sin(request.parameters.theta_td);
  int seen = 0;
  for (const auto& row : RowsOf(request, 1000.0)) {
    if (Number(row, "time_s") > run.segments.at(1).end) break;
    EXPECT_EQ(row.at("contact_arc_rad"), "");
    if (row.at("mode") == "flight") {
      EXPECT_EQ(row.at("contact_x_m"), "") << "no contact in flight, not one at 0";
      continue;
    }
    EXPECT_NEAR(Number(row, "contact_x_m"), foot, 1e-9);
    EXPECT_NEAR(Number(row, "contact_y_m"), 0.0, 1e-9);
    ++seen;
  }
  EXPECT_GT(seen, kEnoughRows);
}

TEST(TrajectoryTables, TheWeightOfAToeStandsOnTheGroundAlone) {
  SimulationRequest request = testing::SteadyStraightLeg();
  request.parameters.m_toe = 2.0;
  request.parameters.kp_place = 500.0;
  request.parameters.kd_place = 50.0;
  const Trajectory run = Simulate(request);
  ASSERT_EQ(run.events.at(0).kind, EventKind::kTouchdown);
  double foot = std::nan("");
  int seen = 0;
  for (const auto& row : RowsOf(request, 1000.0)) {
    if (Number(row, "time_s") > run.segments.at(1).end) break;
    if (row.at("mode") == "flight") continue;
    if (std::isnan(foot)) foot = Number(row, "contact_x_m");
    EXPECT_NEAR(Number(row, "contact_x_m"), foot, 1e-9) << "the foot stands still";
    EXPECT_NEAR(Number(row, "contact_y_m"), 0.0, 1e-9);
    ++seen;
  }
  EXPECT_GT(seen, kEnoughRows);
}

TEST(TrajectoryTables, OnASlopeTheContactLiesOnTheSlope) {
  constexpr double kSlope = 0.05;
  SimulationRequest request = StripLegRequest(Law::kLargeDeflection, Degrees(30.0));
  const std::vector<EffectSetting> effects = {{FindEffect("ground_slope"), {kSlope}}};
  request.effects = effects;
  int seen = 0;
  for (const auto& row : RowsOf(request, 1000.0)) {
    if (row.at("contact_x_m").empty()) continue;
    EXPECT_NEAR(Number(row, "contact_y_m"), Number(row, "contact_x_m") * std::tan(kSlope), 1e-9);
    ++seen;
  }
  EXPECT_GT(seen, kEnoughRows);
  EXPECT_EQ(MechanismRecord(request).at("ground_slope_rad"), kSlope);
}

TEST(TrajectoryTables, SensorsThatAreOffDoNotMoveTheFoot) {
  SimulationRequest request = StripLegRequest(Law::kLargeDeflection, Degrees(30.0));
  const Rows plain = RowsOf(request, 500.0);
  const std::vector<EffectSetting> effects = {{FindEffect("sensor_offset_y"), {0.01}}};
  request.effects = effects;
  const Rows off = RowsOf(request, 500.0);
  ASSERT_EQ(plain.size(), off.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(Number(off[i], "body_y_m") - Number(plain[i], "body_y_m"), 0.01, 1e-12);
    EXPECT_EQ(plain[i].at("contact_y_m"), off[i].at("contact_y_m"));
  }
}

TEST(TrajectoryTables, ABallHasNoLeg) {
  const SimulationRequest request = testing::BallRequest();
  for (const auto& row : RowsOf(request, 100.0)) EXPECT_EQ(row.at("contact_x_m"), "");
  const Json mechanism = MechanismRecord(request);
  EXPECT_EQ(mechanism.at("type"), "ball");
  EXPECT_EQ(mechanism.at("parameters").at("radius"), request.parameters.radius);
}

}  // namespace
}  // namespace hoplab
