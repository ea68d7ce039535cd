#include "optimize/continuation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimize/apex_map.h"
#include "tests/support/controlled_hopper.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

Branch FollowGain(double low, double high) {
  const Hopper hopper = ControlledHopper();
  ApexMap map(hopper);
  return FollowFixedPoint(map, SearchFixedPoint(map, ApexState(1.2, 0.3)),
                          D::Parameter(ParameterId::kKp), {.low = low, .high = high});
}

TEST(Continuation, EveryPointOfABranchIsAFixedPointAndTheBranchCoversItsRange) {
  const Branch branch = FollowGain(2.0, 6.0);
  ASSERT_GE(branch.points.size(), 10u);
  EXPECT_EQ(branch.first_end, BranchEnd::kRange);
  EXPECT_EQ(branch.last_end, BranchEnd::kRange);
  EXPECT_DOUBLE_EQ(branch.points.front().parameter, 2.0);
  EXPECT_DOUBLE_EQ(branch.points.back().parameter, 6.0);
  double before = -1.0;
  for (const BranchPoint& point : branch.points) {
    EXPECT_GT(point.parameter, before);
    before = point.parameter;
    Hopper there = ControlledHopper();
    SetValue(there, D::Parameter(ParameterId::kKp), point.parameter);
    ApexMap map(there);
    const Hop hop = map.Apply(point.fixed_point.state);
    EXPECT_LT((hop.next - point.fixed_point.state).norm(), 1e-10);
  }
}

TEST(Continuation, ABranchThatEndsInAFallSaysSo) {
  const Branch branch = FollowGain(0.0, 4.5);
  ASSERT_FALSE(branch.points.empty());
  EXPECT_NE(branch.first_end, BranchEnd::kRange);
  EXPECT_EQ(branch.last_end, BranchEnd::kRange);
}

TEST(Continuation, TheStraightLegsBranchKeepsItsEnergy) {
  const Hopper hopper{SteadyStraightLeg(), {}};
  ApexMap map(hopper);
  const FixedPoint start = FindFixedPoint(map, ApexState(0.513806075894484, 1.238312718076982));
  const Branch branch = FollowFixedPoint(map, start, D::Parameter(ParameterId::kThetaTd),
                                         {.low = Degrees(3.0), .high = Degrees(8.0)});
  ASSERT_GE(branch.points.size(), 5u);
  for (const BranchPoint& point : branch.points) {
    EXPECT_NEAR(map.SpecificEnergy(point.fixed_point.state), start.specific_energy, 1e-9);
    EXPECT_NEAR(std::abs(point.fixed_point.multipliers[0] * point.fixed_point.multipliers[1]),
                point.fixed_point.spectral_radius, 1e-5)
        << "one multiplier is 1";
  }
}

TEST(Continuation, AChangeOfTheEventSequenceIsFlagged) {
  // With the touch-down angle the stance comes to begin, or end, on the toe.
  const Hopper hopper = ControlledHopper();
  ApexMap map(hopper);
  const Branch branch =
      FollowFixedPoint(map, SearchFixedPoint(map, ApexState(1.2, 0.3)),
                       D::Parameter(ParameterId::kThetaTd), {.low = 0.1, .high = 1.2});
  int changes = 0;
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const bool differs =
        branch.points[i].fixed_point.hop.events != branch.points[i - 1].fixed_point.hop.events;
    EXPECT_EQ(branch.points[i].sequence_changed, differs);
    changes += differs;
  }
  EXPECT_GE(changes, 1);
}

}  // namespace
}  // namespace hoplab
