// Every kind of bad input that the format names: the whole message is compared, place and line, key
// or column, value, rule, remedy.

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

// ---- keys

TEST(BadDataset, AMisspeltKeyGetsTheNearestKnownOne) {
  EXPECT_EQ(ErrorWithYaml("thickness_m", "thicknes_m"),
            "hops/dataset.yaml:12: mechanism.leg.thicknes_m; unknown key. "
            "Did you mean thickness_m?");
}

TEST(BadDataset, AKeyLikeNoOtherGetsTheListOfKnownOnes) {
  EXPECT_EQ(ErrorWithYaml("    role: test\n", "    role: test\n    colour: red\n"),
            "hops/dataset.yaml:24: trials[1].colour; unknown key. Known: file, role, "
            "touchdown_angle_deg, touchdown_angle_sigma_deg, initial, initial_sigma, mechanism, "
            "controller, inputs.");
}

TEST(BadDataset, AnUnknownTopLevelKeyIsNamedByItself) {
  EXPECT_EQ(ErrorWithYaml("channels:", "chanels:"),
            "hops/dataset.yaml:14: chanels; unknown key. Did you mean channels?");
}

TEST(BadDataset, AMissingKeyIsNamedWithItsRange) {
  EXPECT_EQ(ErrorWithYaml("    E_Pa: 22e9\n", ""),
            "hops/dataset.yaml:7: mechanism.leg; must have the key E_Pa. "
            "Add E_Pa: a number in (0, 1e13] Pa.");
}

TEST(BadDataset, AMissingTopLevelKeyIsNamed) {
  EXPECT_EQ(ErrorWithYaml("name: hops\n", ""),
            "hops/dataset.yaml:1: must have the key name. Add name: a short name.");
}

TEST(BadDataset, AKeyWithoutAValueIsTakenAsMissing) {
  EXPECT_EQ(ErrorWithYaml("E_Pa: 22e9", "E_Pa:"),
            "hops/dataset.yaml:9: mechanism.leg; the key E_Pa has no value. "
            "Add E_Pa: a number in (0, 1e13] Pa.");
}

TEST(BadDataset, ADuplicateKeyIsReportedWithBothLines) {
  EXPECT_EQ(ErrorWithYaml("    G_Pa: 4e9\n", "    G_Pa: 4e9\n    E_Pa: 21e9\n"),
            "hops/dataset.yaml:11: E_Pa; duplicate key, it stands already at hops/dataset.yaml:9. "
            "Remove one of the two.");
}

TEST(BadDataset, AKeyOfAnotherMechanismIsToldWhoseItIs) {
  EXPECT_EQ(
      ErrorWithYaml("rest_radius_m: 0.09", "rest_length_m: 0.09"),
      "hops/dataset.yaml:8: mechanism.leg.rest_length_m; unknown key: it belongs to a "
      "straight_leg and this mechanism is a c_leg. Known: rest_radius_m, E_Pa, G_Pa, width_m, "
      "thickness_m, second_moment_m4, area_m2, shear_factor, damping_N_s_per_m, variant.");
}

TEST(BadDataset, ACLegNeedsATouchdownAngle) {
  EXPECT_EQ(ErrorWithYaml("    touchdown_angle_deg: 30\n", ""),
            "hops/dataset.yaml:22: trials[1]; must have the key touchdown_angle_deg. "
            "Add touchdown_angle_deg: a number in (-90, 180) deg.");
}

TEST(BadDataset, TheSectionIsNotGivenTwice) {
  EXPECT_EQ(
      ErrorWithYaml("    width_m: 0.03\n", "    width_m: 0.03\n    area_m2: 1e-4\n"),
      "hops/dataset.yaml:7: mechanism.leg; the section is given by width_m and thickness_m or "
      "by second_moment_m4 and area_m2, not by both. Remove one of the two pairs.");
}

TEST(BadDataset, AWidthNeedsAThickness) {
  EXPECT_EQ(ErrorWithYaml("    thickness_m: 0.0038\n", ""),
            "hops/dataset.yaml:7: mechanism.leg; must have the key thickness_m. "
            "Add thickness_m: a number in (0, 10] m.");
}

TEST(BadDataset, APlacementControllerNeedsAToeMass) {
  EXPECT_EQ(
      ErrorWithYaml("  leg:\n", "  placement: {kp_N_m_per_rad: 1, kd_N_m_s_per_rad: 1}\n  leg:\n"),
      "hops/dataset.yaml:7: mechanism.placement; only a leg with a toe mass is placed by a "
      "torque. Add toe_mass_kg or remove this block.");
}

TEST(BadDataset, AToeWithAMassHasItsOwnRuleOfLiftoff) {
  EXPECT_EQ(ErrorWithYaml("  leg:\n", "  liftoff: rest_length\n  toe_mass_kg: 0.02\n  leg:\n"),
            "hops/dataset.yaml:7: mechanism.liftoff = rest_length; is a rule for massless legs: a "
            "toe with a mass leaves the ground when the leg lifts it. Remove liftoff or "
            "toe_mass_kg.");
  EXPECT_EQ(ErrorWithYaml("  leg:\n", "  liftoff: rest_length\n  toe_mass_kg: 0\n  leg:\n"),
            "(no error)");
}

TEST(BadDataset, AToeMassAndItsGainsAreNoLessThanZeroAndKnownByName) {
  EXPECT_EQ(ErrorWithYaml("  leg:\n", "  toe_mass_kg: -0.01\n  leg:\n"),
            "hops/dataset.yaml:7: mechanism.toe_mass_kg = -0.01; must be in [0, 1e6] kg. "
            "Check the sign.");
  EXPECT_EQ(
      ErrorWithYaml("  leg:\n", "  toe_mass_kg: 0.01\n  placement: {kp_N_m_per_rad: 1}\n  leg:\n"),
      "hops/dataset.yaml:8: mechanism.placement; must have the key kd_N_m_s_per_rad. Add "
      "kd_N_m_s_per_rad: a number in [0, 1e6] N m s/rad.");
  EXPECT_EQ(
      ErrorWithYaml("  leg:\n", "  toe_mass_g: 10\n  leg:\n"),
      "hops/dataset.yaml:7: mechanism.toe_mass_g; is written toe_mass_kg: the unit in its name "
      "does not belong to it. Rename it to toe_mass_kg and give the value in kg.");
}

// ---- units in names

TEST(BadDataset, AModulusInGigapascalIsToldHowTheKeyIsWritten) {
  EXPECT_EQ(
      ErrorWithYaml("E_Pa: 22e9", "E_GPa: 22"),
      "hops/dataset.yaml:9: mechanism.leg.E_GPa; is written E_Pa: the unit in its name does not "
      "belong to it. Rename it to E_Pa and give the value in Pa.");
}

TEST(BadDataset, AMassInGramsIsToldHowTheKeyIsWritten) {
  EXPECT_EQ(ErrorWithYaml("body_mass_kg: 1.0", "body_mass_g: 1000"),
            "hops/dataset.yaml:5: mechanism.body_mass_g; is written body_mass_kg: the unit in its "
            "name does not belong to it. Rename it to body_mass_kg and give the value in kg.");
}

TEST(BadDataset, AHeightInMillimetresIsToldHowTheKeyIsWritten) {
  EXPECT_EQ(
      ErrorWithYaml("y_m: 0.3", "y_mm: 300"),
      "hops/dataset.yaml:21: trials[0].initial.y_mm; is written y_m: the unit in its name does "
      "not belong to it. Rename it to y_m and give the value in m.");
}

TEST(BadDataset, AnAngleInRadiansIsToldHowTheKeyIsWritten) {
  EXPECT_EQ(
      ErrorWithYaml("touchdown_angle_deg: 25", "touchdown_angle_rad: 0.44"),
      "hops/dataset.yaml:20: trials[0].touchdown_angle_rad; is written touchdown_angle_deg: the "
      "unit in its name does not belong to it. Rename it to touchdown_angle_deg and give the "
      "value in deg.");
}

TEST(BadDataset, AKeyWithoutItsUnitIsToldHowItIsWritten) {
  EXPECT_EQ(
      ErrorWithYaml("gravity_m_per_s2", "gravity"),
      "hops/dataset.yaml:6: mechanism.gravity; is written gravity_m_per_s2: its unit stands in "
      "its name. Rename it to gravity_m_per_s2 and give the value in m/s2.");
}

TEST(BadDataset, APureNumberGetsNoUnit) {
  EXPECT_EQ(
      ErrorWithYaml("    G_Pa: 4e9\n", "    G_Pa: 4e9\n    shear_factor_m: 1.5\n"),
      "hops/dataset.yaml:11: mechanism.leg.shear_factor_m; is written shear_factor: it has no "
      "unit. Rename it to shear_factor.");
}

TEST(BadDataset, AChannelWithAnotherUnitIsToldHowItIsWritten) {
  EXPECT_EQ(
      ErrorWithYaml("body_x_m:", "body_x_mm:"),
      "hops/dataset.yaml:15: channels.body_x_mm; is written body_x_m: the unit in its name does "
      "not belong to it. Rename it to body_x_m and give the value in m.");
}

TEST(BadDataset, AColumnWithAnotherUnitIsToldHowItIsWritten) {
  EXPECT_EQ(
      ErrorWithCsv("body_y_m", "body_y_mm"),
      "hops/a.csv:1: column body_y_mm; is written body_y_m: the unit in its name does not belong "
      "to it. Rename it to body_y_m and give the value in m.");
}

// ---- trials and channels

TEST(BadDataset, AFileThatIsNotThereGetsTheNearestThatIs) {
  EXPECT_EQ(ErrorWithYaml("file: a.csv", "file: a.csb"),
            "hops/dataset.yaml:18: trials[0].file = a.csb; there is no such file in the dataset. "
            "Did you mean a.csv?");
}

TEST(BadDataset, AnUnknownChannelGetsTheNearestColumn) {
  EXPECT_EQ(ErrorWithYaml("body_x_m:", "bdy_x_m:"),
            "hops/dataset.yaml:15: channels.bdy_x_m; is no column of the format. "
            "Did you mean body_x_m?");
}

TEST(BadDataset, AChannelThatNoTrialHasIsReported) {
  EXPECT_EQ(ErrorWithYaml("body_x_m:", "hip_torque_N_m:"),
            "hops/dataset.yaml:15: channels.hip_torque_N_m; no trial has a sample of this column. "
            "Remove the channel or add the column to the files.");
}

TEST(BadDataset, AChannelWithoutASampleInAnyTrialIsReported) {
  const std::string csv = "time_s,body_x_m,body_y_m\n0,0,\n1,0,nan\n";
  EXPECT_EQ(InputErrorOf([&] {
              ReadDatasetText(kYaml, {{"a.csv", csv}, {"b.csv", csv}}, "hops");
            }),
            "hops/dataset.yaml:16: channels.body_y_m; no trial has a sample of this column. "
            "Remove the channel or add the column to the files.");
}

TEST(BadDataset, AChannelWhoseColumnIsMisspeltGetsTheColumn) {
  const std::string csv = Replace(kCsv, "body_y_m", "bodyy_m");
  EXPECT_EQ(InputErrorOf([&] {
              ReadDatasetText(kYaml, {{"a.csv", csv}, {"b.csv", csv}}, "hops");
            }),
            "hops/dataset.yaml:16: channels.body_y_m; no trial has a sample of this column. "
            "Is the column bodyy_m meant? Rename it in the files.");
}

TEST(BadDataset, ADatasetWithoutATrainTrialIsReported) {
  EXPECT_EQ(ErrorWithYaml("role: train", "role: test"),
            "hops/dataset.yaml:17: trials; at least one trial must have role: train. "
            "Change the role of the trials to fit.");
}

TEST(BadDataset, ADatasetWithoutTrialsIsReported) {
  const std::string yaml(kYaml);
  EXPECT_EQ(
      ErrorOf(yaml.substr(0, yaml.find("trials:")) + "trials: []\n"),
      "hops/dataset.yaml:17: trials = (a list); must have at least 1 item. Add what is missing.");
}

TEST(BadDataset, ADatasetWithoutChannelsIsReported) {
  const std::string yaml(kYaml);
  EXPECT_EQ(ErrorOf(yaml.substr(0, yaml.find("channels:")) + "channels: {}\n" +
                    yaml.substr(yaml.find("trials:"))),
            "hops/dataset.yaml:14: channels = (a block of keys); must have at least 1 key. "
            "Add what is missing.");
}

TEST(BadDataset, AFileMayNotServeTwoTrials) {
  EXPECT_EQ(
      ErrorWithYaml("file: b.csv", "file: ./a.csv"),
      "hops/dataset.yaml:22: trials[1].file = ./a.csv; is the file of an earlier trial already. "
      "Remove one of the two trials.");
}

TEST(BadDataset, AnAbsolutePathLeavesTheFolder) {
  EXPECT_EQ(
      ErrorWithYaml("file: a.csv", "file: /etc/passwd"),
      "hops/dataset.yaml:18: trials[0].file = /etc/passwd; must lie in the dataset's folder, and "
      "this path is absolute. Move the file there and give its name relative to the folder.");
}

TEST(BadDataset, APathThroughTheParentLeavesTheFolder) {
  EXPECT_EQ(
      ErrorWithYaml("file: a.csv", "file: sub/../../a.csv"),
      "hops/dataset.yaml:18: trials[0].file = sub/../../a.csv; must lie in the dataset's folder, "
      "and this path goes up by ... Move the file there and give its name relative to the "
      "folder.");
}

TEST(BadDataset, ABackslashIsNoSeparator) {
  EXPECT_EQ(ErrorWithYaml("file: a.csv", "file: ..\\a.csv"),
            "hops/dataset.yaml:18: trials[0].file = ..\\a.csv; must be written with /. "
            "Replace \\ by /.");
}

TEST(BadDataset, TheDatasetsOwnFileIsNoTrial) {
  EXPECT_EQ(ErrorWithYaml("file: a.csv", "file: dataset.yaml"),
            "hops/dataset.yaml:18: trials[0].file = dataset.yaml; must be a trial's CSV file. "
            "Give the name of the trial's CSV file.");
}

}  // namespace
}  // namespace hoplab
