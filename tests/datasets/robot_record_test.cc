// A robot whose motors follow a log: read, written back, and refused with place and remedy.

#include <gtest/gtest.h>

#include "datasets/write_dataset.h"
#include "tests/datasets/small_dataset.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;
using testing::Replace;

const char* const kRobotLog =
    "time_s,body_y_m,leg_angle_1_rad,leg_angle_2_rad,hip_torque_1_N_m,hip_torque_2_N_m,wanted\n"
    "0.0,0.30,0.6,0.4,0.1,-0.1,0.40\n"
    "0.1,0.26,0.6,0.4,0.2,-0.2,0.41\n"
    "0.2,0.20,0.6,0.4,0.3,-0.3,0.42\n";
const char* const kRobotYaml =
    "format: hoplab-dataset/1\n"  // 1
    "name: walk\n"                // 2
    "mechanism:\n"                // 3
    "  type: robot\n"             // 4
    "  body_mass_kg: 3\n"         // 5
    "  gravity_m_per_s2: 9.81\n"  // 6
    "  pitch_inertia_kg_m2: 0.05\n"
    "  motor: {rotor_inertia_kg_m2: 0.001, kp_N_m_per_rad: 60, kd_N_m_s_per_rad: 0.8}\n"
    "  leg: {rest_radius_m: 0.09, E_Pa: 22e9, second_moment_m4: 1.8e-10, material_damping_s: 0}\n"
    "  legs: [{hip_m: [-0.12, 0]}, {hip_m: [0.12, 0]}]\n"       // 10
    "controller: {type: recorded, angles_rad: [0.6, 0.4]}\n"    // 11
    "inputs:\n"                                                 // 12
    "  hip_torque_1_N_m: {hold: previous, delay_s: 0.002}\n"    // 13
    "  leg_angle_2_rad: {column: wanted, scale_sigma: 0.01}\n"  // 14
    "channels: {body_y_m: {sigma: 0.001}}\n"                    // 15
    "trials:\n"                                                 // 16
    "  - file: a.csv\n"                                         // 17
    "    role: train\n"
    "    initial: {x_m: 0, y_m: 0.3, vx_m_per_s: 0, vy_m_per_s: 0}\n";

Dataset ReadRobotLog(const std::string& yaml) {
  return ReadDatasetText(yaml, {{"a.csv", kRobotLog}}, "walk");
}
Dataset RobotLogWith(const std::string& from, const std::string& to) {
  return ReadRobotLog(Replace(kRobotYaml, from, to));
}
std::string RobotLogError(const std::string& from, const std::string& to) {
  return InputErrorOf([&] { RobotLogWith(from, to); });
}
void ExpectSameAgain(const Dataset& dataset) {
  std::map<std::string, std::string> files = FormatDataset(dataset);
  EXPECT_EQ(ReadDatasetText(files["dataset.yaml"], files), dataset) << files["dataset.yaml"];
}

TEST(RecordedMotors, AreDrivenEachByItsOwnColumn) {
  const Dataset dataset = ReadRobotLog(kRobotYaml);
  const MotorsSpec& motors = *dataset.trials[0].controller->motors;
  EXPECT_EQ(motors.kind, MotorControl::kRecorded);
  EXPECT_EQ(motors.angles_rad, (std::vector<double>{0.6, 0.4}));
  EXPECT_TRUE(motors.rates_rad_per_s.empty());
  ASSERT_EQ(dataset.trials[0].inputs.size(), 2u);
  EXPECT_EQ(dataset.trials[0].inputs[0].id, InputKind::kHipTorque1);
  EXPECT_TRUE(dataset.trials[0].inputs[0].held);
  EXPECT_EQ(dataset.trials[0].inputs[1].id, InputKind::kLegAngle2);
  EXPECT_EQ(dataset.trials[0].inputs[1].column, "wanted");
  ExpectSameAgain(dataset);
}

TEST(RecordedMotors, MayBeginFastOrOnTheirReferences) {
  const Dataset fast =
      RobotLogWith("angles_rad: [0.6, 0.4]", "angles_rad: [0.6, 0.4], rates_rad_per_s: [1, -2]");
  EXPECT_EQ(fast.controller->motors->rates_rad_per_s, (std::vector<double>{1, -2}));
  ExpectSameAgain(fast);
  const std::string on_reference = Replace(
      kRobotYaml, "hip_torque_1_N_m: {hold: previous, delay_s: 0.002}", "leg_angle_1_rad: {}");
  const Dataset dataset = ReadRobotLog(Replace(on_reference, ", angles_rad: [0.6, 0.4]", ""));
  EXPECT_TRUE(dataset.controller->motors->angles_rad.empty());
  ExpectSameAgain(dataset);
}

TEST(RecordedMotors, OfATrialMayBeHeldInstead) {
  const Dataset dataset =
      RobotLogWith("    role: train\n",
                   "    role: train\n    controller: {type: held}\n"
                   "    inputs: {hip_torque_1_N_m: null, leg_angle_2_rad: null}\n");
  EXPECT_EQ(dataset.trials[0].controller->motors->kind, MotorControl::kHeld);
  EXPECT_TRUE(dataset.trials[0].inputs.empty());
  ExpectSameAgain(dataset);
}

TEST(BadRecordedMotors, AreToldWithPlaceValueRuleAndRemedy) {
  const std::string torque = "hip_torque_1_N_m: {hold: previous, delay_s: 0.002}";
  EXPECT_EQ(RobotLogError("  " + torque + "\n", ""),
            "walk/dataset.yaml:16: trials[0].inputs.hip_torque_1_N_m; is absent, and so is "
            "leg_angle_1_rad: nothing drives motor 1. Add one of the two to `inputs`: the torque "
            "the motor was told, or the angle its controller followed.");
  EXPECT_EQ(RobotLogError(torque, torque + "\n  leg_angle_1_rad: {}"),
            "walk/dataset.yaml:18: trials[0].inputs.hip_torque_1_N_m and leg_angle_1_rad; both "
            "drive one motor. Remove one of the two.");
  EXPECT_EQ(RobotLogError(", angles_rad: [0.6, 0.4]", ""),
            "walk/dataset.yaml:17: trials[0].controller.angles_rad; is absent, and a torque drives "
            "motor 1: where does it begin?. Add angles_rad, the motors' angles at the first row, "
            "one a leg.");
  EXPECT_EQ(RobotLogError("type: recorded", "type: held"),
            "walk/dataset.yaml:13: trials[0].inputs.hip_torque_1_N_m; the motors follow a "
            "controller of type held, and a log drives this one too. Write controller: {type: "
            "recorded}, or remove the input.");
  EXPECT_EQ(RobotLogError("hip_torque_1_N_m: {", "hip_torque_N_m: {column: hip_torque_1_N_m, "),
            "walk/dataset.yaml:13: trials[0].inputs.hip_torque_N_m; a robot has a motor at each "
            "hip. Say which: hip_torque_1_N_m, the hindmost.");
  EXPECT_EQ(RobotLogError("leg_angle_2_rad: {", "leg_angle_3_rad: {"),
            "walk/dataset.yaml:14: trials[0].inputs.leg_angle_3_rad; the robot has 2 legs. Remove "
            "it.");
  EXPECT_EQ(RobotLogError("[0.6, 0.4]}", "[0.6, 0.4], rates_rad_per_s: [1]}"),
            "walk/dataset.yaml:11: controller.rates_rad_per_s = (a list); must have one rate for "
            "each angle of angles_rad. Give angles_rad and rates_rad_per_s, one of each a leg, or "
            "neither.");
}

TEST(BadRecordedMotors, OfAHopperAreItsHip) {
  EXPECT_EQ(testing::ErrorWithYaml("channels:", "inputs: {hip_torque_2_N_m: {}}\nchannels:"),
            "hops/dataset.yaml:14: trials[0].inputs.hip_torque_2_N_m; drives a motor of a robot, "
            "and this mechanism is a c_leg. Write hip_torque_N_m.");
}

}  // namespace
}  // namespace hoplab
