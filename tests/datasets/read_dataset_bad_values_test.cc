// Values that a dataset may not have: the whole message is compared.

#include <gtest/gtest.h>

#include <string>

#include "datasets/read_dataset.h"
#include "tests/datasets/small_dataset.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::ErrorOf;
using testing::ErrorWithCsv;
using testing::ErrorWithYaml;
using testing::InputErrorOf;
using testing::kCsv;
using testing::kYaml;
using testing::Replace;

TEST(BadDataset, ANegativeModulusIsOutOfItsRange) {
  EXPECT_EQ(
      ErrorWithYaml("E_Pa: 22e9", "E_Pa: -4"),
      "hops/dataset.yaml:9: mechanism.leg.E_Pa = -4; must be in (0, 1e13] Pa. Check the sign.");
}

TEST(BadDataset, AMassOfZeroIsOutOfItsRange) {
  EXPECT_EQ(ErrorWithYaml("body_mass_kg: 1.0", "body_mass_kg: 0"),
            "hops/dataset.yaml:5: mechanism.body_mass_kg = 0; must be in (0, 1e6] kg. "
            "Check the unit: kg is meant.");
}

TEST(BadDataset, AnAngleBeyondTheHalfTurnIsOutOfItsRange) {
  EXPECT_EQ(ErrorWithYaml("touchdown_angle_deg: 25", "touchdown_angle_deg: 180"),
            "hops/dataset.yaml:20: trials[0].touchdown_angle_deg = 180; must be in (-90, 180) deg. "
            "Check the unit: deg is meant.");
}

TEST(BadDataset, AStartAlongTheGroundOnAGuideIsRefused) {
  EXPECT_EQ(
      ErrorWithYaml("gravity_m_per_s2: 9.81\n", "gravity_m_per_s2: 9.81\n  guide: vertical\n"),
      "hops/dataset.yaml:19: trials[0]; begins with vx_m_per_s = 1, and a vertical guide "
      "holds the body along the ground. Write vx_m_per_s: 0, or guide: none.");
}

TEST(BadDataset, ASigmaOfZeroIsOutOfItsRange) {
  EXPECT_EQ(ErrorWithYaml("sigma: 0.001", "sigma: 0"),
            "hops/dataset.yaml:15: channels.body_x_m.sigma = 0; must be in [1e-12, 1e9] m. "
            "Check the unit: m is meant.");
}

TEST(BadDataset, ASigmaNextToZeroIsOutOfItsRange) {
  EXPECT_EQ(ErrorWithYaml("sigma: 0.001", "sigma: 1e-160"),
            "hops/dataset.yaml:15: channels.body_x_m.sigma = 1e-160; must be in [1e-12, 1e9] m. "
            "Check the unit: m is meant.");
}

TEST(BadDataset, ARestitutionAboveOneIsOutOfItsRange) {
  const std::string yaml =
      "format: hoplab-dataset/1\nname: b\n"
      "mechanism: {type: ball, body_mass_kg: 1, gravity_m_per_s2: 9.81,\n"
      "  ball: {radius_m: 0.02, restitution: 1.2, tangential_loss: 0}}\n"
      "channels: {body_y_m: {sigma: 0.001}}\ntrials: [{file: a.csv, role: train}]\n";
  EXPECT_EQ(ErrorOf(yaml),
            "hops/dataset.yaml:4: mechanism.ball.restitution = 1.2; must be in [0, 1]. "
            "Check the value.");
}

TEST(BadDataset, InfinityIsNoValue) {
  EXPECT_EQ(ErrorWithYaml("E_Pa: 22e9", "E_Pa: .inf"),
            "hops/dataset.yaml:9: mechanism.leg.E_Pa = .inf; must be in (0, 1e13] Pa. "
            "Write a finite number.");
}

TEST(BadDataset, ANumberTooLargeForADoubleIsNoValue) {
  EXPECT_EQ(ErrorWithYaml("E_Pa: 22e9", "E_Pa: 1e999"),
            "hops/dataset.yaml:9: mechanism.leg.E_Pa = 1e999; must be in (0, 1e13] Pa. "
            "Write a finite number.");
}

TEST(BadDataset, NanIsNoValueInTheYaml) {
  EXPECT_EQ(ErrorWithYaml("E_Pa: 22e9", "E_Pa: nan"),
            "hops/dataset.yaml:9: mechanism.leg.E_Pa = nan; must be in (0, 1e13] Pa. "
            "Write a finite number.");
}

TEST(BadDataset, ANumberWithAUnitBehindItIsNoNumber) {
  EXPECT_EQ(
      ErrorWithYaml("E_Pa: 22e9", "E_Pa: 22 GPa"),
      "hops/dataset.yaml:9: mechanism.leg.E_Pa = 22 GPa; is not a number; must be in (0, 1e13] "
      "Pa. Write a number such as 0.09 or 22e9, without unit.");
}

TEST(BadDataset, ADecimalCommaIsToldAsOne) {
  EXPECT_EQ(ErrorWithYaml("E_Pa: 22e9", "E_Pa: 2,2e10"),
            "hops/dataset.yaml:9: mechanism.leg.E_Pa = 2,2e10; is not a number; must be in "
            "(0, 1e13] Pa. The decimal sign is a point: 2.2e10.");
  EXPECT_EQ(ErrorWithYaml("{sigma: 0.001}", "{sigma: 0,001}"),
            "hops/dataset.yaml:15: channels.body_x_m.001; is a number where a key is wanted. The "
            "decimal sign is a point; a comma in braces begins the next key.");
}

TEST(BadDataset, AListWhereANumberIsWantedIsOfTheWrongType) {
  EXPECT_EQ(ErrorWithYaml("E_Pa: 22e9", "E_Pa: [21e9, 22e9]"),
            "hops/dataset.yaml:9: mechanism.leg.E_Pa = (a list); must be one number; must be in "
            "(0, 1e13] Pa. Write a single number here.");
}

TEST(BadDataset, ANumberWhereABlockIsWantedIsOfTheWrongType) {
  EXPECT_EQ(ErrorWithYaml("{sigma: 0.001}", "0.001"),
            "hops/dataset.yaml:15: channels.body_x_m = 0.001; must be a block of keys and values. "
            "Write `key: value` lines, or {key: value}.");
}

TEST(BadDataset, ABlockWhereAListIsWantedIsOfTheWrongType) {
  const std::string yaml(kYaml);
  EXPECT_EQ(
      ErrorOf(yaml.substr(0, yaml.find("trials:")) + "trials: {file: a.csv}\n"),
      "hops/dataset.yaml:17: trials = (a block of keys); must be a list. Write `- ` before each "
      "item, or [a, b].");
}

TEST(BadDataset, AListWhereTextIsWantedIsOfTheWrongType) {
  EXPECT_EQ(
      ErrorWithYaml("name: hops", "name: [hops]"),
      "hops/dataset.yaml:2: name = (a list); must be text. Write one text here, in quotes if it "
      "has a colon or brackets.");
}

TEST(BadDataset, AnUnknownMechanismTypeGetsTheNearestKnownOne) {
  EXPECT_EQ(ErrorWithYaml("type: c_leg", "type: cleg"),
            "hops/dataset.yaml:4: mechanism.type = cleg; must be one of c_leg, straight_leg, ball, "
            "robot. Did you mean c_leg?");
}

TEST(BadDataset, AnUnknownRoleIsRefused) {
  EXPECT_EQ(ErrorWithYaml("role: test", "role: validation"),
            "hops/dataset.yaml:23: trials[1].role = validation; must be one of train, test. "
            "Write one of these words.");
}

TEST(BadDataset, ASigmaMayBeANumberOrEstimateAndNothingElse) {
  EXPECT_EQ(ErrorWithYaml("sigma: estimate", "sigma: guess"),
            "hops/dataset.yaml:16: channels.body_y_m.sigma = guess; must be a number in [1e-12, "
            "1e9] m or "
            "the word estimate. Write 1 standard deviation, or estimate.");
}

TEST(BadDataset, ATrialMayNotChangeTheTypeOfMechanism) {
  EXPECT_EQ(ErrorWithYaml(
                "    role: test\n",
                "    role: test\n    mechanism: {type: straight_leg, leg: {rest_radius_m: null, "
                "E_Pa: null, G_Pa: null, width_m: null, thickness_m: null, rest_length_m: 0.1, "
                "stiffness_N_per_m: 100}}\n"),
            "hops/dataset.yaml:24: trials[1].mechanism.type = straight_leg; all trials must have "
            "the same "
            "type of mechanism. Make a dataset of its own for it.");
}

TEST(BadDataset, ATrialsOwnMechanismValueIsCheckedAtItsOwnLine) {
  EXPECT_EQ(
      ErrorWithYaml("    role: test\n", "    role: test\n    mechanism:\n      leg: {E_Pa: -1}\n"),
      "hops/dataset.yaml:25: trials[1].mechanism.leg.E_Pa = -1; must be in (0, 1e13] Pa. "
      "Check the sign.");
}

TEST(BadDataset, AHostileValueIsShownOnOneShortLine) {
  EXPECT_EQ(
      ErrorWithYaml("E_Pa: 22e9", "E_Pa: \"\\e[31m" + std::string(200, 'x') + "\""),
      "hops/dataset.yaml:9: mechanism.leg.E_Pa = \\x1b[31m" + std::string(55, 'x') +
          "...; is not a number; must be in (0, 1e13] Pa. Write a number such as 0.09 or 22e9, "
          "without unit.");
}

}  // namespace
}  // namespace hoplab
