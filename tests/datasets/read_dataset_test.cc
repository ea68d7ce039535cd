#include "datasets/read_dataset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "tests/datasets/small_dataset.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using testing::kCsv;
using testing::kYaml;
using testing::Read;
using testing::ReadWithCsv;
using testing::ReadWithYaml;
using testing::Replace;

std::string WithLineEnds(std::string text, const std::string& end) {
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + end.size()))
    text.replace(at, 1, end);
  return text;
}

TEST(ReadDataset, GivesSiUnitsAndRadians) {
  const Dataset dataset = Read(kYaml);
  EXPECT_EQ(dataset.name, "hops");
  EXPECT_EQ(dataset.mechanism.type, MechanismKind::kCLeg);
  EXPECT_EQ(dataset.mechanism.c_leg.E_Pa, 22e9);
  EXPECT_EQ(dataset.trials[0].touchdown_angle_rad, DegToRad(25));
  EXPECT_EQ(dataset.trials[0].role, TrialRole::kTrain);
  EXPECT_EQ(dataset.trials[1].role, TrialRole::kTest);
  EXPECT_EQ(dataset.trials[0].initial, (StateSpec{0, 0.3, 1, 0}));
  EXPECT_FALSE(dataset.trials[1].initial);
}

TEST(ReadDataset, TakesTheSectionFromWidthAndThickness) {
  const CLegSpec leg = Read(kYaml).mechanism.c_leg;
  EXPECT_DOUBLE_EQ(leg.second_moment_m4, 0.03 * std::pow(0.0038, 3) / 12);
  EXPECT_DOUBLE_EQ(leg.area_m2, 0.03 * 0.0038);
}

TEST(ReadDataset, TakesTheSectionFromMomentAndArea) {
  const CLegSpec leg = Read(Replace(Replace(kYaml, "width_m: 0.03", "second_moment_m4: 1.4e-10"),
                                    "thickness_m: 0.0038", "area_m2: 1.1e-4"))
                           .mechanism.c_leg;
  EXPECT_EQ(leg.second_moment_m4, 1.4e-10);
  EXPECT_EQ(leg.area_m2, 1.1e-4);
  EXPECT_FALSE(leg.width_m);
}

TEST(ReadDataset, HasTheStatedDefaults) {
  const Dataset dataset = Read(kYaml);
  EXPECT_EQ(dataset.mechanism.c_leg.shear_factor, 1.5);
  EXPECT_EQ(dataset.mechanism.liftoff, LiftoffRule::kZeroForce);
  EXPECT_FALSE(dataset.mechanism.fall_height_m);
  EXPECT_FALSE(dataset.mechanism.toe_mass_kg);
  EXPECT_FALSE(dataset.controller);
  EXPECT_FALSE(dataset.trials[0].initial_sigma);
  EXPECT_EQ(dataset.source.kind, SourceKind::kUnstated);
}

TEST(ReadDataset, ReadsTheOptionalMechanismKeys) {
  const MechanismSpec mechanism =
      ReadWithYaml("  leg:\n",
                   "  fall_height_m: 0.04\n  toe_mass_kg: 0.02\n"
                   "  placement: {kp_N_m_per_rad: 2, kd_N_m_s_per_rad: 0.1}\n  leg:\n")
          .mechanism;
  EXPECT_EQ(mechanism.liftoff, LiftoffRule::kZeroForce);
  EXPECT_EQ(mechanism.fall_height_m, 0.04);
  EXPECT_EQ(mechanism.toe_mass_kg, 0.02);
  EXPECT_EQ(mechanism.placement, (PlacementSpec{2, 0.1}));
  EXPECT_EQ(ReadWithYaml("  leg:\n", "  liftoff: rest_length\n  leg:\n").mechanism.liftoff,
            LiftoffRule::kRestLength);
}

TEST(ReadDataset, ReadsAStraightLeg) {
  const std::string yaml =
      "format: hoplab-dataset/1\nname: s\nmechanism:\n  type: straight_leg\n  body_mass_kg: 1\n"
      "  gravity_m_per_s2: 9.81\n"
      "  leg: {rest_length_m: 0.2, stiffness_N_per_m: 2e3, damping_N_s_per_m: 0}\n"
      "channels: {body_y_m: {sigma: 0.001}}\n"
      "trials: [{file: a.csv, role: train, touchdown_angle_deg: -5}]\n";
  const Dataset dataset = Read(yaml);
  EXPECT_EQ(dataset.mechanism.straight_leg, (StraightLegSpec{0.2, 2e3, 0}));
  EXPECT_EQ(dataset.trials[0].touchdown_angle_rad, DegToRad(-5));
}

TEST(ReadDataset, ABallNeedsNoTouchdownAngle) {
  const std::string yaml =
      "format: hoplab-dataset/1\nname: b\n"
      "mechanism: {type: ball, body_mass_kg: 0.0027, gravity_m_per_s2: 9.81,\n"
      "  ball: {radius_m: 0.02, restitution: 0.85, tangential_loss: 0.1}}\n"
      "channels: {body_y_m: {sigma: 0.001}}\ntrials: [{file: a.csv, role: train}]\n";
  const Dataset dataset = Read(yaml);
  EXPECT_EQ(dataset.mechanism.ball, (BallSpec{0.02, 0.85, 0.1}));
  EXPECT_EQ(dataset.trials[0].touchdown_angle_rad, 0);
}

// Of 1.2 kg/m^3, unless it says otherwise.
TEST(ReadDataset, ABallThatWasRecordedFlewInAir) {
  const auto air_of = [](const std::string& source, const std::string& stated,
                         const std::string& trial) {
    return Read("format: hoplab-dataset/1\nname: b\n" + source +
                "mechanism: {type: ball, body_mass_kg: 0.0027, gravity_m_per_s2: 9.81,\n"
                "  ball: {radius_m: 0.02, restitution: 0.85, tangential_loss: 0.1" +
                stated +
                "}}\nchannels: {body_y_m: {sigma: 0.001}}\n"
                "trials: [{file: a.csv, role: train" +
                trial + "}]\n")
        .trials[0]
        .mechanism.ball.air_density_kg_per_m3;
  };
  const std::string recorded = "source: {kind: recorded}\n",
                    simulated = "source: {kind: simulated}\n";
  EXPECT_EQ(air_of(recorded, "", ""), 1.2);
  EXPECT_EQ(air_of(recorded, "", ", mechanism: {body_mass_kg: 0.0028}"), 1.2);
  EXPECT_EQ(air_of(recorded, ", air_density_kg_per_m3: 0", ""), 0.0);
  EXPECT_EQ(air_of(recorded, ", air_density_kg_per_m3: 1.1", ", mechanism: {body_mass_kg: 1}"),
            1.1);
  EXPECT_EQ(air_of(simulated, "", ""), std::nullopt);
  EXPECT_EQ(air_of("", "", ""), std::nullopt);
}

TEST(ReadDataset, ASigmaToBeEstimatedIsAbsent) {
  const Dataset dataset = Read(kYaml);
  EXPECT_EQ(dataset.channels[0].sigma, 0.001);
  EXPECT_FALSE(dataset.channels[1].sigma);
}

TEST(ReadDataset, AContactChannelNeedsNoSigma) {
  const std::string yaml = Replace(kYaml, "channels:\n", "channels:\n  contact: {}\n");
  const Dataset dataset = Read(yaml, "time_s,body_x_m,body_y_m,contact\n0,0,0.3,0\n1,0,0.2,1\n");
  EXPECT_EQ(dataset.channels[0].id, Channel::kContact);
  EXPECT_FALSE(dataset.channels[0].sigma);
}

TEST(ReadDataset, AnAbsentComponentOfTheInitialSigmaIsFree) {
  const Dataset dataset =
      ReadWithYaml("    role: test\n", "    role: test\n    initial_sigma: {x_m: 0.002}\n");
  EXPECT_EQ(dataset.trials[1].initial_sigma,
            (StateSpec{0.002, kFreeSigma, kFreeSigma, kFreeSigma}));
}

TEST(ReadDataset, ATrialsOwnValuesOverrideTheDatasets) {
  const std::string yaml =
      Replace(Replace(kYaml, "channels:\n",
                      "controller: {kp_N_s: 2, v_des_m_per_s: 1.8, torque_limit_N_m: 10}\n"
                      "initial: {x_m: 1, y_m: 0.4, vx_m_per_s: 0, vy_m_per_s: 0}\nchannels:\n"),
              "    role: test\n",
              "    role: test\n    controller: {kp_N_s: 3}\n    mechanism: {leg: {E_Pa: 21e9}}\n"
              "    initial: {y_m: 0.5}\n");
  const Dataset dataset = Read(yaml);
  EXPECT_EQ(dataset.trials[0].controller, (ControllerSpec{2, 1.8, 10}));
  EXPECT_EQ(dataset.trials[1].controller, (ControllerSpec{3, 1.8, 10}));
  EXPECT_EQ(dataset.trials[0].mechanism.c_leg.E_Pa, 22e9);
  EXPECT_EQ(dataset.trials[1].mechanism.c_leg.E_Pa, 21e9);
  EXPECT_EQ(dataset.trials[1].mechanism.c_leg.G_Pa, 4e9);
  EXPECT_EQ(dataset.mechanism.c_leg.E_Pa, 22e9);
  EXPECT_EQ(dataset.trials[0].initial, (StateSpec{0, 0.3, 1, 0}));
  EXPECT_EQ(dataset.trials[1].initial, (StateSpec{1, 0.5, 0, 0}));
}

TEST(ReadDataset, NullUnderATrialTakesTheDatasetsValueAway) {
  const std::string yaml = Replace(
      Replace(kYaml, "channels:\n", "controller: {kp_N_s: 2, v_des_m_per_s: 1.8}\nchannels:\n"),
      "    role: test\n", "    role: test\n    controller: null\n");
  const Dataset dataset = Read(yaml);
  EXPECT_TRUE(dataset.trials[0].controller);
  EXPECT_FALSE(dataset.trials[1].controller);
}

TEST(ReadDataset, ATrialMayGiveItsSectionTheOtherWay) {
  const Dataset dataset = ReadWithYaml(
      "    role: test\n",
      "    role: test\n    mechanism: {leg: {second_moment_m4: 1e-10, area_m2: 1e-4}}\n");
  EXPECT_EQ(dataset.trials[1].mechanism.c_leg.second_moment_m4, 1e-10);
  EXPECT_FALSE(dataset.trials[1].mechanism.c_leg.width_m);
  EXPECT_TRUE(dataset.trials[0].mechanism.c_leg.width_m);
}

TEST(ReadDataset, TakesNumbersInEveryUsualNotation) {
  for (const char* number : {"22e9", "2.2E+10", "+22000000000", "22000000000.", "\"22e9\""})
    EXPECT_EQ(ReadWithYaml("22e9", number).mechanism.c_leg.E_Pa, 22e9) << number;
}

TEST(ReadDataset, TakesAnySortOfLineEnds) {
  const Dataset unix_ends = Read(kYaml);
  EXPECT_EQ(Read(WithLineEnds(kYaml, "\r\n"), WithLineEnds(kCsv, "\r\n")), unix_ends);
  EXPECT_EQ(Read(WithLineEnds(kYaml, "\r"), WithLineEnds(kCsv, "\r")), unix_ends);
}

TEST(ReadDataset, LineNumbersAreRightWithWindowsLineEnds) {
  EXPECT_EQ(
      testing::InputErrorOf(
          [] { Read(WithLineEnds(Replace(kYaml, "E_Pa: 22e9", "E_Pa: -4"), "\r\n")); }),
      "hops/dataset.yaml:9: mechanism.leg.E_Pa = -4; must be in (0, 1e13] Pa. Check the sign.");
}

TEST(ReadDataset, TakesAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(Read(mark + kYaml, mark + kCsv), Read(kYaml));
}

TEST(ReadDataset, TakesATrailingNewlineOrNone) {
  const std::string yaml(kYaml), csv(kCsv);
  EXPECT_EQ(Read(yaml.substr(0, yaml.size() - 1), csv.substr(0, csv.size() - 1)), Read(kYaml));
  EXPECT_EQ(Read(yaml + "\n\n", csv + "\n\n"), Read(kYaml));
}

TEST(ReadDataset, TakesCommentsAndBlanksInTraces) {
  EXPECT_EQ(
      Read(kYaml, "# recorded today\n" + Replace(kCsv, "0.02,0.02", "# mark\n\n 0.02 ,\t0.02")),
      Read(kYaml));
}

TEST(ReadDataset, TakesSmallHonestAliases) {
  const Dataset dataset =
      Read(Replace(Replace(kYaml, "body_x_m: {sigma: 0.001}", "body_x_m: &noise {sigma: 0.001}"),
                   "body_y_m: {sigma: estimate}", "body_y_m: *noise"));
  EXPECT_EQ(dataset.channels[1].sigma, 0.001);
}

TEST(ReadDataset, AnEmptyCellAndNanAreMissingSamples) {
  const Dataset dataset = Read(kYaml, "time_s,body_x_m,body_y_m\n0,,0.3\n1,NaN,0.2\n2,0.5,0.1\n");
  const std::vector<double>& x = *dataset.trials[0].trace.Find(Channel::kBodyX);
  EXPECT_TRUE(std::isnan(x[0]));
  EXPECT_TRUE(std::isnan(x[1]));
  EXPECT_EQ(x[2], 0.5);
}

TEST(ReadDataset, KeepsColumnsThatAreNoChannel) {
  const Dataset dataset = Read(kYaml, "time_s,body_x_m,body_y_m,battery_level\n0,0,0.3,99\n");
  EXPECT_EQ(dataset.trials[0].trace.Find("battery_level")->front(), 99);
}

TEST(ReadDataset, AChannelMayBeMissingInSomeTrials) {
  const Dataset dataset = Read(kYaml, "time_s,body_x_m\n0,0\n");
  EXPECT_EQ(dataset.trials[0].trace.Find(Channel::kBodyY), nullptr);
}

TEST(ReadDataset, TakesUnevenSteps) {
  EXPECT_EQ(ReadWithCsv("0.02,", "0.029,").trials[0].trace.time_s,
            (std::vector<double>{0, 0.01, 0.029, 0.03}));
}

TEST(ReadDataset, TakesFilesInASubfolder) {
  const testing::TempFolder temp;
  testing::WriteText(temp.path() / "dataset.yaml", Replace(kYaml, "a.csv", "sub/a.csv"));
  testing::WriteText(temp.path() / "sub" / "a.csv", kCsv);
  testing::WriteText(temp.path() / "b.csv", kCsv);
  EXPECT_EQ(ReadDataset(temp.path()).trials[0].file, "sub/a.csv");
}

TEST(ReadDataset, TakesALinkThatStaysInTheFolder) {
  const testing::TempFolder temp;
  testing::WriteText(temp.path() / "dataset.yaml", kYaml);
  testing::WriteText(temp.path() / "b.csv", kCsv);
  std::filesystem::create_symlink("b.csv", temp.path() / "a.csv");
  EXPECT_EQ(ReadDataset(temp.path()).trials.size(), 2u);
}

}  // namespace
}  // namespace hoplab
