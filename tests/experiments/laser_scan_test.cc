// The laser-scanning task on the mechanism that two_legs_test.cc holds against its oracles.
#include "experiments/kinematics/laser_scan.h"

#include <gtest/gtest.h>

#include "base/units.h"

namespace hoplab::testing {
namespace {

LaserScanRequest Request(int jobs) {
  return {TwoLegs{}, DegToRad(30), DegToRad(90), 5, DegToRad(5), DegToRad(10), jobs};
}

TEST(LaserScan, InitialStatesCoverTheGridWithTheFrontAngleFastest) {
  const std::vector<ScanStart> initial_states = ScanInitialStates(Request(1));
  ASSERT_EQ(initial_states.size(), 25u);
  EXPECT_DOUBLE_EQ(initial_states[0].angles.rear, DegToRad(30));
  EXPECT_DOUBLE_EQ(initial_states[1].angles.front, DegToRad(45));
  EXPECT_DOUBLE_EQ(initial_states[24].angles.rear, DegToRad(90));
}

TEST(LaserScan, APairIsFeasibleWhereItsRangeIncludesTheWantedOne) {
  int feasible = 0;
  for (const ScanStart& start : ScanInitialStates(Request(1))) {
    EXPECT_EQ(start.feasible, start.range.lowest <= DegToRad(5) + 1e-12 &&
                                  start.range.highest >= DegToRad(10) - 1e-12);
    EXPECT_LE(start.range.lowest, start.start_pitch);
    EXPECT_GE(start.range.highest, start.start_pitch);
    feasible += start.feasible ? 1 : 0;
    // Above the diagonal the body leans back, below it forward: 5 to 10 deg are out of reach there.
    EXPECT_FALSE(start.feasible && start.angles.front <= start.angles.rear);
  }
  EXPECT_GT(feasible, 0);
}

TEST(LaserScan, TheStudysExampleSweepsTheWantedRange) {
  const RollingPair pair(TwoLegs{}, {DegToRad(45), DegToRad(75)});
  const Travel travel = TravelOf(pair);
  const PitchRange range = PitchRangeOf(pair, travel);
  EXPECT_LT(RadToDeg(range.lowest), 5.0);
  EXPECT_GT(RadToDeg(range.highest), 10.0);
  const std::vector<Pose> poses = PosesAlong(pair, travel, 50);
  ASSERT_EQ(poses.size(), 50u);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_GT(poses[i].motor_rear, poses[i - 1].motor_rear);
    EXPECT_LT(poses[i].pitch, poses[i - 1].pitch) << "the body comes down as the rear rises";
  }
}

TEST(LaserScan, JobsDoNotChangeIt) {
  const std::vector<ScanStart> one = ScanInitialStates(Request(1)),
                               three = ScanInitialStates(Request(3));
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].range.lowest, three[i].range.lowest);
    EXPECT_EQ(one[i].range.highest, three[i].range.highest);
  }
}

}  // namespace
}  // namespace hoplab::testing
