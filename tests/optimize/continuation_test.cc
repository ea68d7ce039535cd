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

// A map whose fixed points z = p end at z = 0.5; below that there are those of another branch,
// z = p - 0.5.
class TwoBranches : public ReturnMap {
 public:
  using ReturnMap::ReturnMap;
  std::unique_ptr<ReturnMap> Clone() const override { return std::make_unique<TwoBranches>(*this); }
  Hop Differentiate(const SectionState& z, std::span<const D> parameters) override {
    const double p = hopper().request.parameters.kp;
    const bool first = z[0] >= 0.5;
    Hop hop;
    hop.returned = true;
    hop.outcome = Outcome::kHopLimit;
    hop.least_crossing_rate = hop.nearest_miss = 1e9;
    hop.next = SectionState::Constant(1, first ? p : z[0] + 0.5 * (p - 0.5 - z[0]));
    hop.jacobian = Eigen::MatrixXd::Constant(1, 1, first ? 0.0 : 0.5);
    if (!parameters.empty()) hop.by_parameter = Eigen::MatrixXd::Constant(1, 1, first ? 1.0 : 0.5);
    return hop;
  }
  Hop Apply(const SectionState& z) override { return Differentiate(z, {}); }
  std::vector<SectionComponent> Components(const SectionState&) const override {
    return {{"z", 1.0}};
  }
  double SpecificEnergy(const SectionState&) const override { return 0.0; }
  Eigen::RowVectorXd SpecificEnergyRate(const SectionState&) const override {
    return Eigen::RowVectorXd::Zero(1);
  }
  bool ConservesEnergy(const SectionState&) override { return false; }
};

TEST(Continuation, ABranchThatIsLostEndsThereAndNoOtherGoesOnInItsPlace) {
  TwoBranches map(ControlledHopper());
  const D gain = D::Parameter(ParameterId::kKp);
  SetValue(map.hopper(), gain, 0.8);
  const FixedPoint start = FindFixedPoint(map, SectionState::Constant(1, 0.8));
  ASSERT_TRUE(start.found());
  const Branch branch = FollowFixedPoint(map, start, gain, {.low = 0.0, .high = 1.0});
  for (const BranchPoint& point : branch.points)
    EXPECT_NEAR(point.fixed_point.state[0], point.parameter, 1e-9);
  EXPECT_NEAR(branch.points.front().parameter, 0.5, 1e-3);
  EXPECT_EQ(branch.first_end, BranchEnd::kLost);
  EXPECT_EQ(branch.last_end, BranchEnd::kRange);
  EXPECT_DOUBLE_EQ(branch.points.back().parameter, 1.0);
}

}  // namespace
}  // namespace hoplab
