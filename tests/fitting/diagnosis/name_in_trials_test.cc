// What is there in one trial alone, in all of them, or in both coordinates.

#include <gtest/gtest.h>

#include "tests/support/naming.h"

namespace hoplab {
namespace {

using testing::EffectOfSize;
using testing::GroupNames;
using testing::MembersOf;
using testing::NameIn;
using testing::NameSix;
using testing::NullFit;

TEST(NameCauses, AnEffectInOneTrialIsNamedAsSuch) {
  Dataset d = testing::DatasetOf({});
  d.trials[1] =
      testing::DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}).trials[1];
  const Naming n = NameSix(NullFit(d));
  ASSERT_FALSE(n.groups.empty());
  EXPECT_EQ(MembersOf(n), std::vector<std::string>{"touchdown_angle_bias in train-2.csv"});
  EXPECT_NEAR(n.best.ValuesOf(0)[0], 0.03, 0.005);
}

// In all trials alike it is their modulus, which is fitted.
TEST(NameCauses, ASofterLegInOneTrialIsNamedAsSuch) {
  const std::vector<Candidate> candidates =
      testing::CandidatesOf({"leg_stiffness", "leg_hardening", "touchdown_angle_bias"});
  Dataset d = testing::DatasetOf({});
  d.trials[1] = testing::DatasetOf({.effects = {EffectOfSize("leg_stiffness", -0.14)}}).trials[1];
  const Naming n = NameIn(NullFit(d), candidates);
  EXPECT_EQ(MembersOf(n), std::vector<std::string>{"leg_stiffness in train-2.csv"});
  EXPECT_NEAR(n.best.ValuesOf(0)[0], -0.14, 0.02);
  EXPECT_TRUE(
      MembersOf(NameIn(NullFit({.effects = {EffectOfSize("leg_stiffness", -0.14)}}), candidates))
          .empty());
}

TEST(NameCauses, AScaleOfThePictureIsNoPairOfScales) {
  const Naming n = NameIn(NullFit({.effects = {EffectOfSize("camera_scale", 0.02)}}),
                          testing::CandidatesOf({"camera_scale", "sensor_scale_x", "sensor_scale_y",
                                                 "clock_scale", "rest_radius_scale"}));
  EXPECT_EQ(MembersOf(n), std::vector<std::string>{"camera_scale"});
  EXPECT_NEAR(n.best.ValuesOf(0)[0], 0.02, 0.004);
}

TEST(NameCauses, AnEffectInEveryTrialIsNotLaidToOne) {
  const Naming n = NameSix(NullFit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}));
  for (const std::string& name : GroupNames(n))
    EXPECT_EQ(name.find(" in "), std::string::npos) << name;
}

}  // namespace
}  // namespace hoplab
