// Logs of robots: what columns are taken for what leg, and what dataset.yaml is made of them.

#include <gtest/gtest.h>

#include "datasets/import/robot_name.h"
#include "datasets/read_dataset.h"
#include "tests/datasets/import_samples.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::Format;
using testing::ImportFile;
using testing::InputErrorOf;
using testing::TempFolder;
using testing::WriteText;
using Strings = std::vector<std::string>;
using Quantity = RobotName::Quantity;

// ---- names

struct Named {
  const char *title, *unit;
  Quantity quantity;
};

TEST(RobotNames, UsualTitlesAreRead) {
  for (const Named& n : std::vector<Named>{{"pitch", "", Quantity::kPitch},
                                           {"body_pitch_deg", "deg", Quantity::kPitch},
                                           {"theta [rad]", "rad", Quantity::kPitch},
                                           {"q1", "", Quantity::kAngle},
                                           {"motor_1_angle", "", Quantity::kAngle},
                                           {"legAngle2", "", Quantity::kAngle},
                                           {"phi1_deg", "deg", Quantity::kAngle},
                                           {"theta_2", "", Quantity::kAngle},
                                           {"log.q(:,1)", "", Quantity::kAngle},
                                           {"Motor 3 pos (deg)", "deg", Quantity::kAngle},
                                           {"hip_front [deg]", "deg", Quantity::kAngle},
                                           {"q_des_1", "", Quantity::kReference},
                                           {"motor_1_cmd [rad]", "rad", Quantity::kReference},
                                           {"tau_1", "", Quantity::kTorque},
                                           {"torque_left_front", "", Quantity::kTorque},
                                           {"motorTorqueLF", "", Quantity::kTorque},
                                           {"tau_cmd_2", "", Quantity::kToldTorque},
                                           {"contact_rear", "", Quantity::kContact},
                                           {"foot_1_contact", "", Quantity::kContact}}) {
    const auto name = ReadRobotName(n.title, n.unit);
    ASSERT_TRUE(name) << n.title;
    EXPECT_EQ(name->quantity, n.quantity) << n.title;
  }
  EXPECT_EQ(ReadRobotName("tau_lr", "")->place, RobotName::Place::kRear);
  EXPECT_EQ(ReadRobotName("tau_rr", "")->place, RobotName::Place::kRear);
  EXPECT_EQ(ReadRobotName("tau_rf", "")->place, RobotName::Place::kFront);
}

TEST(RobotNames, WhatIsSomethingElseIsNot) {
  for (const char* title : {"time_s",
                            "x",
                            "hip.Position.Y",
                            "pitch_rate",
                            "q1dot",
                            "dq1",
                            "knee_angle_r",
                            "phi",
                            "joint_1_velocity",
                            "motor_1_current",
                            "hip_flexion_r",
                            "ankle angle",
                            "temperature_1",
                            "leg_1_angle_filtered",
                            "leg_angle",
                            "hip_torque",
                            "contact",
                            "leg_length_1",
                            "1",
                            ""})
    EXPECT_FALSE(ReadRobotName(title, "")) << title;
  EXPECT_FALSE(ReadRobotName("q1 [mm]", "mm"));        // of another kind
  EXPECT_FALSE(ReadRobotName("q1 [ticks]", "ticks"));  // unknown
}

// ---- guesses

class ImportRobot : public ::testing::Test {
 protected:
  // A fall of 0.1 s with these columns more, each with the samples of `cell`.
  std::filesystem::path Log(const Strings& titles, const std::string& cell = "0.5") {
    std::string text = "t [s],x [m],y [m]";
    for (const std::string& title : titles) text += "," + title;
    text += "\n";
    for (int i = 0; i < 60; ++i) {
      const double t = 0.002 * i;
      text += Format("%.3f", t) + "," + Format("%.4f", 0.3 * t) + "," +
              Format("%.5f", 0.3 - 4.905 * t * t);
      for (std::size_t c = 0; c < titles.size(); ++c) text += "," + cell;
      text += "\n";
    }
    WriteText(temp_.path() / "log.csv", text);
    return temp_.path() / "log.csv";
  }
  // The --map options of a robot's columns.
  static Strings Legs(const ImportResult& made) {
    Strings texts;
    for (std::size_t i = 0; i < made.map.columns.size(); ++i)
      if (made.map.columns[i].target.IsRobots()) texts.push_back(made.map_texts[i]);
    return texts;
  }
  TempFolder temp_;
};

TEST_F(ImportRobot, LegsAreNumberedFromTheHindmost) {
  EXPECT_EQ(Legs(ImportFile(Log({"pitch [deg]", "q0 [deg]", "q1 [deg]"}), {})),
            (Strings{"body_pitch=pitch [deg]:deg", "leg_angle_1=q0 [deg]:deg",
                     "leg_angle_2=q1 [deg]:deg"}));
  const ImportResult made = ImportFile(
      Log({"theta [rad]", "front angle [rad]", "rear angle [rad]", "tau_front [Nm]"}), {});
  EXPECT_EQ(Legs(made),
            (Strings{"body_pitch=theta [rad]:rad", "leg_angle_1=rear angle [rad]:rad",
                     "leg_angle_2=front angle [rad]:rad", "hip_torque_2=tau_front [Nm]:N m"}));
  EXPECT_EQ(made.type, MechanismKind::kRobot);
  EXPECT_EQ(made.legs, 2);
  EXPECT_TRUE(made.map.HasGuesses());
}

TEST_F(ImportRobot, ItsOwnNamesAreNoGuess) {
  const ImportResult made =
      ImportFile(Log({"body_pitch_rad", "leg_angle_1_rad", "leg_angle_2_rad"}), {});
  EXPECT_EQ(Legs(made).size(), 3u);
  for (const MappedColumn& mapped : made.map.columns)
    if (mapped.target.IsRobots()) {
      EXPECT_FALSE(mapped.guessed) << TargetName(mapped.target);
    }
}

TEST_F(ImportRobot, AHopperWithAPitchStaysAHopper) {
  const ImportResult made = ImportFile(Log({"pitch [deg]", "leg_angle [deg]"}), {});
  EXPECT_EQ(made.type, MechanismKind::kCLeg);
  EXPECT_TRUE(Legs(made).empty());
}

TEST_F(ImportRobot, LegsThatCannotBeToldApartAreNotTakenAndSaid) {
  const auto note = [&](const Strings& titles) {
    const ImportResult made = ImportFile(Log(titles), {});
    std::string notes;
    for (const std::string& n : made.notes) notes += n + "\n";
    return std::to_string(Legs(made).size()) + " " + notes;
  };
  std::string said = note({"pitch [rad]", "q1 [rad]", "q2 [rad]", "tau_1 [Nm]", "torque 1 [Nm]"});
  EXPECT_EQ(said.substr(0, 2), "3 ");
  EXPECT_NE(said.find("tau_1 [Nm], torque 1 [Nm] may each be hip_torque_1_N_m"), said.npos) << said;
  said = note({"pitch [rad]", "rear angle [rad]", "q_lf [rad]", "q_rf [rad]"});
  EXPECT_EQ(said.substr(0, 2), "2 ");
  EXPECT_NE(said.find("Legs that move together are one"), said.npos) << said;
}

TEST_F(ImportRobot, LegsThatDoNotBeginWithZeroOrOneAreNoHoppers) {
  const auto file = Log({"pitch [rad]", "q2 [rad]", "q3 [rad]"});
  EXPECT_NE(InputErrorOf([&] { ImportFile(file, {}); }).find("which do not run from 0 or 1"),
            std::string::npos);
}

TEST_F(ImportRobot, SixLegsAreNotTakenForFour) {
  const auto file =
      Log({"pitch [rad]", "q1 [rad]", "q2 [rad]", "q3 [rad]", "q4 [rad]", "q5 [rad]", "q6 [rad]"});
  EXPECT_NE(InputErrorOf([&] { ImportFile(file, {}); }).find("has a pitch and 6 legs by their"),
            std::string::npos);
  ImportRequest request;
  request.logs = {{file}};
  request.name = "six";
  request.type = MechanismKind::kCLeg;
  EXPECT_EQ(ImportLogs(request).type, MechanismKind::kCLeg);
  request.type = MechanismKind::kRobot;
  EXPECT_NE(InputErrorOf([&] { ImportLogs(request); }).find("--legs: how many legs"),
            std::string::npos);
  request.legs = 2;
  EXPECT_NE(ImportLogs(request).notes.at(0).find("6 legs by their numbers"), std::string::npos);
}

TEST_F(ImportRobot, UnitsOfAnglesAreToldByHowFarTheyReach) {
  const Strings titles = {"pitch", "q1", "q2"};
  EXPECT_EQ(Legs(ImportFile(Log(titles, "0.5"), {})).at(1), "leg_angle_1=q1:rad");
  EXPECT_EQ(Legs(ImportFile(Log(titles, "35"), {})).at(1), "leg_angle_1=q1:deg");
  EXPECT_EQ(Legs(ImportFile(Log(titles, "35"), {})).at(0), "body_pitch=pitch:deg");
  ImportRequest request;
  request.logs = {{Log(titles, "0.5")}};
  request.units = {*FindUnit("deg")};
  request.name = "said";
  EXPECT_EQ(Legs(ImportLogs(request)).at(2), "leg_angle_2=q2:deg");
}

TEST_F(ImportRobot, AUnitThatNothingTellsIsAskedFor) {
  const std::string error = InputErrorOf([&] {
    ImportFile(Log({"pitch", "q1", "q2", "tau_1"}), {});
  });
  EXPECT_NE(error.find("column tau_1; its unit stands nowhere and cannot be told from the numbers. "
                       "Units of torque: "),
            std::string::npos)
      << error;
  EXPECT_NE(error.find("or --unit 'N m' for all"), std::string::npos) << error;
}

TEST_F(ImportRobot, AWalkerThatNeverFallsHasItsHeightByName) {
  std::string text = "t [s],x [mm],z [mm],pitch [rad],q1 [rad],q2 [rad]\n";
  for (int i = 0; i < 60; ++i)
    text += Format("%.3f", 0.002 * i) + Format(",%.1f", 2 * i) + ",200,0,0.5,0.5\n";
  WriteText(temp_.path() / "walk.csv", text);
  const ImportResult made = ImportFile(temp_.path() / "walk.csv", {});
  EXPECT_EQ(made.map_texts.back(), "x=x [mm]:mm");
  EXPECT_EQ(made.map_texts[made.map_texts.size() - 2], "y=z [mm]:mm");
}

// ---- dataset.yaml

TEST_F(ImportRobot, MotorsFollowTheReferencesOfALog) {
  const ImportResult made =
      ImportFile(Log({"pitch [rad]", "q1 [rad]", "q2 [rad]", "q1_des [deg]", "q2_des [deg]"}), {});
  const std::string& yaml = made.files.at("dataset.yaml");
  for (const char* says :
       {"controller: {type: recorded}\n", "  leg_angle_1_rad: {column: reference_1_rad}\n",
        "  leg_angle_2_rad: {column: reference_2_rad}\n", "    - hip_m:  # the hindmost leg",
        "    initial: {x_m: "})
    EXPECT_NE(yaml.find(says), std::string::npos) << says << yaml;
  EXPECT_TRUE(made.files.at("log.csv").starts_with(
      "time_s,body_x_m,body_y_m,body_pitch_rad,leg_angle_1_rad,leg_angle_2_rad,"
      "reference_1_rad,reference_2_rad\n"));
  EXPECT_EQ(made.blanks.size(), 12u);  // ten of the mechanism, two hips
}

TEST_F(ImportRobot, ATorqueThatDrivesAMotorAsksWhereItBegins) {
  const auto file = Log({"pitch [rad]", "a [rad]", "b [Nm]", "c [Nm]"});
  const ImportResult made =
      ImportFile(file, {"t=t", "x=x", "y=y", "body_pitch=pitch", "leg_angle_1=a", "told_torque_1=b",
                        "told_torque_2=c"});
  EXPECT_EQ(made.legs, 2);
  EXPECT_EQ(made.blanks.back().key, "trials[0].controller.angles_rad");
  EXPECT_EQ(InputErrorOf([&] {
              ImportFile(file, {"t=t", "y=y", "leg_angle_2=a", "reference_2=a"});
            }).substr(0, 62),
            "--map: reference_1; is absent, and a log drives other motors: ");
}

TEST_F(ImportRobot, WithoutItsOwnPlaceTheStartIsAskedFor) {
  const ImportResult made = ImportFile(Log({"pitch [rad]", "q1 [rad]"}),
                                       {"t=t", "y=y", "body_pitch=pitch", "leg_angle_1=q1"});
  EXPECT_EQ(made.blanks.back().key, "trials[0].initial");
}

TEST_F(ImportRobot, AStartIsTheParabolaOfTheFirstRows) {
  const ImportResult made = ImportFile(Log({"pitch [rad]", "q1 [rad]"}), {});
  const std::string& yaml = made.files.at("dataset.yaml");
  const std::size_t at = yaml.find("initial: {");
  const YamlNode state =
      ParseYamlValue(yaml.substr(at + 9, yaml.find('\n', at) - at - 9), "initial");
  EXPECT_NEAR(std::stod(state.Find("y_m")->text), 0.3, 1e-5);
  EXPECT_NEAR(std::stod(state.Find("vx_m_per_s")->text), 0.3, 1e-3);
  EXPECT_NEAR(std::stod(state.Find("vy_m_per_s")->text), 0.0, 1e-3);
  EXPECT_NEAR(std::stod(state.Find("pitch_rate_rad_per_s")->text), 0.0, 1e-9);
}

}  // namespace
}  // namespace hoplab
