// What a log of a real machine brings along: angles hop by hop, columns that drive the simulation,
// clocks of sensors, starts in stance. Read, written back, and refused with place and remedy.

#include "datasets/read_record.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "datasets/write_dataset.h"
#include "tests/datasets/small_dataset.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;
using testing::Replace;

// Two drops: down through 0.17 m (touch-down at 25 deg: 0.1716 m), up, down again.
const char* const kRecordedHops =
    "time_s,body_y_m,leg_angle_rad,hip_torque_N_m,command\n"
    "0.0,0.30,0.50,0.1,1\n"
    "0.1,0.19,0.44,0.2,1\n"
    "0.2,0.15,0.10,0.3,2\n"
    "0.3,0.25,0.60,0.4,2\n"
    "0.4,0.18,0.40,0.5,3\n"
    "0.5,0.14,0.20,0.6,3\n";
const char* const kRecordYaml =
    "format: hoplab-dataset/1\n"  // 1
    "name: hops\n"                // 2
    "mechanism:\n"                // 3
    "  type: c_leg\n"             // 4
    "  body_mass_kg: 1.0\n"       // 5
    "  gravity_m_per_s2: 9.81\n"  // 6
    "  leg: {rest_radius_m: 0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, "
    "damping_N_s_per_m: 3}\n"                 // 7
    "channels: {body_y_m: {sigma: 0.001}}\n"  // 8
    "trials:\n"                               // 9
    "  - file: a.csv\n"                       // 10
    "    role: train\n"                       // 11
    "    touchdown_angle_deg: 25\n";          // 12

Dataset ReadRecord(const std::string& yaml, const std::string& csv = kRecordedHops) {
  return ReadDatasetText(yaml, {{"a.csv", csv}}, "hops");
}
// kRecordYaml with one line changed.
Dataset RecordWith(const std::string& from, const std::string& to) {
  return ReadRecord(Replace(kRecordYaml, from, to));
}
std::string RecordErrorWith(const std::string& from, const std::string& to,
                            const std::string& csv = kRecordedHops) {
  return InputErrorOf([&] { ReadRecord(Replace(kRecordYaml, from, to), csv); });
}
std::string ErrorOfAngle(const std::string& angle, const std::string& csv = kRecordedHops) {
  return RecordErrorWith("touchdown_angle_deg: 25", "touchdown_angle_deg: " + angle, csv);
}
std::string ErrorOfInputs(const std::string& inputs) {
  return RecordErrorWith("trials:", "inputs: " + inputs + "\ntrials:");
}
void ExpectRoundTrip(const Dataset& dataset) {
  std::map<std::string, std::string> files = FormatDataset(dataset);
  const Dataset again = ReadDatasetText(files["dataset.yaml"], files);
  EXPECT_EQ(again, dataset) << files["dataset.yaml"];
}

// ---- angles

TEST(TouchdownAngles, AreAListOnePerTouchdown) {
  const Dataset dataset = RecordWith("deg: 25", "deg: [25, 22.5]");
  const Trial& trial = dataset.trials[0];
  EXPECT_EQ(trial.touchdown_angles_rad, (std::vector<double>{DegToRad(25), DegToRad(22.5)}));
  EXPECT_EQ(trial.touchdown_angle_rad, DegToRad(25));
  ExpectRoundTrip(dataset);
}

TEST(TouchdownAngles, AreReadFromTheMeasuredColumnAtContact) {
  const Dataset dataset = RecordWith("deg: 25", "deg: {from: leg_angle}");
  const std::vector<double>& angles = dataset.trials[0].touchdown_angles_rad;
  ASSERT_EQ(angles.size(), 2u);
  // Between 0.1 s, 0.19 m and 0.2 s, 0.15 m, where y - H(angle) changes sign: the angle of a trace
  // whose leg angle jumps lies between the two samples.
  EXPECT_LT(angles[0], 0.44);
  EXPECT_GT(angles[0], 0.10);
  EXPECT_LT(angles[1], 0.40);
  EXPECT_GT(angles[1], 0.20);
  ExpectRoundTrip(dataset);
}

TEST(TouchdownAngles, AreReadWhereTheContactColumnSaysWhenItHasOne) {
  const std::string csv =
      "time_s,contact,leg_angle_rad\n0,0,0.5\n0.1,0,0.4\n0.2,1,0.3\n0.3,0,0.6\n0.4,1,0.5\n";
  const Dataset dataset =
      ReadRecord(Replace(Replace(kRecordYaml, "deg: 25", "deg: {from: leg_angle}"),
                         "{body_y_m: {sigma: 0.001}}", "{contact: {}}"),
                 csv);
  ASSERT_EQ(dataset.trials[0].touchdown_angles_rad.size(), 2u);
  EXPECT_NEAR(dataset.trials[0].touchdown_angles_rad[0], 0.35, 1e-12);
  EXPECT_NEAR(dataset.trials[0].touchdown_angles_rad[1], 0.55, 1e-12);
}

TEST(TouchdownAngles, WithASigmaEachHopHasItsOwnAboutTheOneGiven) {
  const Dataset dataset = RecordWith("deg: 25\n", "deg: 25\n    touchdown_angle_sigma_deg: 0.5\n");
  const Trial& trial = dataset.trials[0];
  EXPECT_EQ(trial.touchdown_angles_rad, (std::vector<double>{DegToRad(25), DegToRad(25)}));
  EXPECT_EQ(trial.touchdown_angle_sigma_rad, DegToRad(0.5));
  ExpectRoundTrip(dataset);
}

struct Bad {
  std::string error, says;
};
void ExpectSays(const std::vector<Bad>& table) {
  for (const Bad& bad : table) EXPECT_EQ(bad.error, bad.says);
}

TEST(BadTouchdownAngles, AreToldWithPlaceValueRuleAndRemedy) {
  ExpectSays({
      {ErrorOfAngle("[25]"),
       "hops/dataset.yaml:10: touchdown_angle_deg has 1 angle; hops/a.csv shows 2 touch-downs, and "
       "each needs its own. Add what is missing, or end the record before."},
      {ErrorOfAngle("[]"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg = (a list); must have at least 1 item. "
       "Add what is missing."},
      {ErrorOfAngle("[25, 200]"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg[1] = 200; must be in (-90, 180) deg. "
       "Check the unit: deg is meant."},
      {ErrorOfAngle("[25, ahead]"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg[1] = ahead; is not a number; must be "
       "in (-90, 180) deg. Write a number such as 0.09 or 22e9, without unit."},
      {ErrorOfAngle("{from: leg_angel}"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg.from = leg_angel; must be one of "
       "leg_angle. Did you mean leg_angle?"},
      {ErrorOfAngle("{at: leg_angle}"),
       "hops/dataset.yaml:12: trials[0].touchdown_angle_deg.at; unknown key. Known: from."},
      {ErrorOfAngle("{from: leg_angle}", "time_s,body_y_m\n0,0.3\n0.1,0.1\n"),
       "hops/dataset.yaml:10: touchdown_angle_deg = {from: leg_angle}; hops/a.csv has no column "
       "leg_angle_rad to read it from. Add the column, or give the angles."},
      {ErrorOfAngle("{from: leg_angle}", "time_s,body_y_m,leg_angle_rad\n0,0.3,1\n0.1,0.29,1\n"),
       "hops/dataset.yaml:10: touchdown_angle_deg = {from: leg_angle}; hops/a.csv shows no "
       "touch-down. Give the angle itself."},
      {ErrorOfAngle("{from: leg_angle}", "time_s,body_y_m,leg_angle_rad\n0,0.3,25\n0.1,0.1,25\n"),
       "hops/a.csv: leg_angle_rad = 25 at 0.0604 s; the leg touches down there; must be in (-90, "
       "180) deg. Check its unit and where it counts from: 0 is upright, ahead positive."},
  });
}

// ---- inputs

TEST(Inputs, AreColumnsThatDriveTheSimulation) {
  const Dataset dataset = RecordWith(
      "trials:",
      "clocks: {motor: {offset_s: 0.001, sigma_s: 0.002, per: trial}}\n"
      "inputs:\n"
      "  hip_torque_N_m: {hold: previous, delay_s: 0.002, delay_sigma_s: 0.001, clock: motor}\n"
      "  body_force_x_N: {column: command, scale: 2, scale_sigma: 0.1}\n"
      "trials:");
  ASSERT_EQ(dataset.trials[0].inputs.size(), 2u);
  const InputSpec& torque = dataset.trials[0].inputs[0];
  EXPECT_EQ(torque.id, InputKind::kHipTorque);
  EXPECT_EQ(torque.column, "hip_torque_N_m");
  EXPECT_TRUE(torque.held);
  EXPECT_EQ(torque.delay_s, 0.002);
  EXPECT_EQ(torque.delay_sigma_s, 0.001);
  EXPECT_EQ(torque.clock, "motor");
  const InputSpec& force = dataset.trials[0].inputs[1];
  EXPECT_EQ(force.column, "command");
  EXPECT_FALSE(force.held);
  EXPECT_EQ(force.scale, 2);
  EXPECT_EQ(force.scale_sigma, 0.1);
  EXPECT_EQ(dataset.clocks[0].sigma_s, 0.002);
  EXPECT_TRUE(dataset.clocks[0].per_trial);
  ExpectRoundTrip(dataset);
}

TEST(Inputs, OfATrialArePutOverTheDatasets) {
  const std::string yaml = Replace(
      Replace(kRecordYaml, "trials:",
              "inputs: {hip_torque_N_m:, body_force_y_N: {column: command}}\n"
              "trials:"),
      "deg: 25\n", "deg: 25\n    inputs: {body_force_y_N: null, hip_torque_N_m: {scale: 3}}\n");
  const Dataset dataset = ReadRecord(yaml);
  EXPECT_EQ(dataset.inputs.size(), 2u);
  ASSERT_EQ(dataset.trials[0].inputs.size(), 1u);
  EXPECT_EQ(dataset.trials[0].inputs[0].scale, 3);
  ExpectRoundTrip(dataset);
}

TEST(Inputs, ALegAngleSaysWhereTheLegTouchesDown) {
  const Dataset dataset =
      ReadRecord(Replace(Replace(kRecordYaml, "trials:", "inputs: {leg_angle_rad: {}}\ntrials:"),
                         "    touchdown_angle_deg: 25\n", ""));
  EXPECT_TRUE(dataset.trials[0].touchdown_angles_rad.empty());
  ExpectRoundTrip(dataset);
}

TEST(BadInputs, AreToldWithPlaceValueRuleAndRemedy) {
  const std::string controller = "controller: {kp_N_s: 1, v_des_m_per_s: 1}\n";
  const std::string toe = "  toe_mass_kg: 0.01\n  leg:";
  ExpectSays({
      {ErrorOfInputs("{torque_N_m: {}}"),
       "hops/dataset.yaml:9: inputs.torque_N_m; is nothing that can drive a simulation. Did you "
       "mean hip_torque_N_m?"},
      {ErrorOfInputs("{hip_torque_mN_m: {}}"),
       "hops/dataset.yaml:9: inputs.hip_torque_mN_m; is written hip_torque_N_m: the unit in its "
       "name "
       "does not belong to it. Rename it to hip_torque_N_m and give the value in N m."},
      {ErrorOfInputs("{hip_torque_N_m: {hold: next}}"),
       "hops/dataset.yaml:9: inputs.hip_torque_N_m.hold = next; must be one of linear, previous. "
       "Write one of these words."},
      {ErrorOfInputs("{hip_torque_N_m: {delay_ms: 2}}"),
       "hops/dataset.yaml:9: inputs.hip_torque_N_m.delay_ms; is written delay_s: the unit in its "
       "name does not belong to it. Rename it to delay_s and give the value in s."},
      {ErrorOfInputs("{hip_torque_N_m: {delay_s: 2}}"),
       "hops/dataset.yaml:9: inputs.hip_torque_N_m.delay_s = 2; must be in [-1, 1] s. Check the "
       "unit: s is meant."},
      {ErrorOfInputs("{hip_torque_N_m: {scale_sigma: 0}}"),
       "hops/dataset.yaml:9: inputs.hip_torque_N_m.scale_sigma = 0; must be in (0, 1e6]. Check the "
       "value."},
      {ErrorOfInputs("{hip_torque_N_m: {clock: motor}}"),
       "hops/dataset.yaml:9: inputs.hip_torque_N_m.clock = motor; is no clock of this dataset. Add "
       "it, as clocks: {motor: {offset_s: 0}}."},
      {ErrorOfInputs("{hip_torque_N_m: {column: comand}}"),
       "hops/dataset.yaml:9: inputs.hip_torque_N_m; hops/a.csv has no column comand. Did you mean "
       "command? Say column: command."},
      {ErrorOfInputs("{body_force_x_N: {}}"),
       "hops/dataset.yaml:9: inputs.body_force_x_N; hops/a.csv has no column body_force_x_N. Add "
       "the column, or write body_force_x_N: null under `inputs` of the trial."},
      {ErrorOfInputs("{hip_torque_N_m: {column: body_y_m}}"),
       "hops/dataset.yaml:9: inputs.hip_torque_N_m; the column body_y_m is a channel too: it "
       "either "
       "drives the simulation or is compared with it. Remove it from `channels`, or name another "
       "column, as column: commanded."},
      {ErrorOfInputs("{leg_angle_rad: {}}"),
       "hops/dataset.yaml:13: trials[0].touchdown_angle_deg; the input leg_angle_rad says at which "
       "angle the leg touches down. Remove one of the two."},
      {RecordErrorWith("trials:", controller + "inputs: {hip_torque_N_m: {}}\ntrials:"),
       "hops/dataset.yaml:10: trials[0].inputs.hip_torque_N_m; the hip torque comes from the log, "
       "and a controller is given too. Remove one of the two; `controller: null` in a trial takes "
       "it away there."},
      {InputErrorOf([&] {
         ReadRecord(Replace(Replace(kRecordYaml, "  leg:", toe),
                            "trials:", "inputs: {hip_torque_N_m: {}}\ntrials:"));
       }),
       "hops/dataset.yaml:10: trials[0].inputs.hip_torque_N_m; a leg with a toe mass is moved by "
       "its "
       "placement, not by a log. Remove toe_mass_kg or this input."},
      {RecordErrorWith("trials:", "inputs: {hip_torque_N_m: {}}\ntrials:",
                       "time_s,body_y_m,hip_torque_N_m\n0,0.3,\n0.1,0.29,\n"),
       "hops/dataset.yaml:9: inputs.hip_torque_N_m; hops/a.csv has no sample in the column "
       "hip_torque_N_m. Fill it in, or write hip_torque_N_m: null under `inputs` of the trial."},
      {RecordErrorWith("trials:", "inputs: {hip_torque_N_m: {column: u}}\ntrials:",
                       "time_s,body_y_m,u\n0,0.3,1\n0.1,0.29,5e7\n"),
       "hops/a.csv, row 2: u = 5e7; must be in [-1e6, 1e6] N m to drive hip_torque_N_m. Check the "
       "unit: N m is meant."},
      {RecordErrorWith("deg: 25\n", "deg: 25\n",
                       "time_s,body_y_m,body_force_x_kN\n0,0.3,1\n0.1,0.29,5\n"),
       "hops/a.csv:1: column body_force_x_kN; is written body_force_x_N: the unit in its name does "
       "not belong to it. Rename it to body_force_x_N and give the value in N."},
  });
}

// ---- clocks

TEST(Clocks, AreNamedByTheirChannels) {
  const Dataset dataset = RecordWith(
      "channels: {body_y_m: {sigma: 0.001}}",
      "channels: {body_y_m: {sigma: 0.001}, hip_torque_N_m: {sigma: 0.01, clock: motor}}\n"
      "clocks: {motor: {sigma_s: 0.002}}");
  EXPECT_EQ(dataset.channels[1].clock, "motor");
  EXPECT_EQ(dataset.clocks[0].offset_s, 0);
  EXPECT_FALSE(dataset.clocks[0].per_trial);
  ExpectRoundTrip(dataset);
}

TEST(BadClocks, AreToldWithPlaceValueRuleAndRemedy) {
  const auto of = [](const std::string& clocks, const std::string& clock) {
    return RecordErrorWith(
        "channels: {body_y_m: {sigma: 0.001}}",
        "channels: {body_y_m: {sigma: 0.001, clock: " + clock + "}}\nclocks: " + clocks);
  };
  ExpectSays({
      {of("{motor: {}}", "moter"),
       "hops/dataset.yaml:8: channels.body_y_m.clock = moter; is no clock of this dataset. Did you "
       "mean motor?"},
      {of("{motor: {offset_ms: 2}}", "motor"),
       "hops/dataset.yaml:9: clocks.motor.offset_ms; is written offset_s: the unit in its name "
       "does "
       "not belong to it. Rename it to offset_s and give the value in s."},
      {of("{motor: {sigma_s: -1}}", "motor"),
       "hops/dataset.yaml:9: clocks.motor.sigma_s = -1; must be in (0, 1] s. Check the sign."},
      {of("{motor: {per: hop}}", "motor"),
       "hops/dataset.yaml:9: clocks.motor.per = hop; must be one of dataset, trial. Write one of "
       "these words."},
      {of("{motor: {per: trial}}", "motor"),
       "hops/dataset.yaml:9: clocks.motor.per = trial; says that the offset differs between "
       "trials, "
       "but not by how much. Add sigma_s, one standard deviation in s."},
      {of("{}", "motor"),
       "hops/dataset.yaml:9: clocks = (a block of keys); must have at least 1 key. Add what is "
       "missing."},
  });
}

// ---- starts

TEST(Starts, MayLieInStance) {
  const std::string start =
      "deg: 25\n    initial: {x_m: 0, y_m: 0.15, vx_m_per_s: 1, vy_m_per_s: -1, contact_x_m: 0.03";
  const std::string sigma = "\n    initial_sigma: {y_m: 0.002, contact_x_m: 0.004}\n";
  for (const auto& [mode, expected] : {std::pair(", mode: rolling}", StartMode::kRolling),
                                       {", mode: toe}", StartMode::kToe},
                                       {", mode: stance}", StartMode::kStance},
                                       {"}", StartMode::kStance}}) {
    const Dataset dataset = RecordWith("deg: 25\n", start + mode + sigma);
    ASSERT_TRUE(dataset.trials[0].initial);
    EXPECT_EQ(dataset.trials[0].initial->mode, expected);
    EXPECT_EQ(dataset.trials[0].initial->contact_x_m, 0.03);
    EXPECT_EQ(dataset.trials[0].initial_sigma->contact_x_m, 0.004);
    ExpectRoundTrip(dataset);
  }
}

TEST(BadStarts, AreToldWithPlaceValueRuleAndRemedy) {
  const auto of = [](const std::string& more, const std::string& yaml = kRecordYaml) {
    return InputErrorOf([&] {
      ReadRecord(Replace(yaml, "deg: 25\n",
                         "deg: 25\n    initial: {x_m: 0, y_m: 0.15, vx_m_per_s: 1, vy_m_per_s: -1" +
                             more + "}\n"));
    });
  };
  const std::string straight =
      Replace(Replace(kRecordYaml, "c_leg", "straight_leg"),
              "{rest_radius_m: 0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, "
              "damping_N_s_per_m: 3}",
              "{rest_length_m: 0.2, stiffness_N_per_m: 1000, damping_N_s_per_m: 0}");
  const std::string ball = Replace(
      Replace(Replace(kRecordYaml, "c_leg", "ball"), "    touchdown_angle_deg: 25\n",
              "    touchdown_angle_deg: 25\n"),
      "leg: {rest_radius_m: 0.09, E_Pa: 22e9, G_Pa: 4e9, width_m: 0.03, thickness_m: 0.0038, "
      "damping_N_s_per_m: 3}",
      "ball: {radius_m: 0.03, restitution: 0.8, tangential_loss: 0}");
  ExpectSays({
      {of(", mode: rolling"),
       "hops/dataset.yaml:13: trials[0].initial.mode = rolling; is a start in stance, which needs "
       "contact_x_m. Add contact_x_m, the place of the ground that carries the leg."},
      {of(", contact_x_m: 0.1, mode: flight"),
       "hops/dataset.yaml:13: trials[0].initial.mode = flight; is a start in flight, which has no "
       "contact. Remove contact_x_m, or say mode: stance."},
      {of(", contact_x_m: 0.1, mode: standing"),
       "hops/dataset.yaml:13: trials[0].initial.mode = standing; must be one of flight, rolling, "
       "toe, stance. Write one of these words."},
      {of(", contact_mm: 3"),
       "hops/dataset.yaml:13: trials[0].initial.contact_mm; unknown key. Did you mean "
       "contact_x_m?"},
      {of(", contact_x_m: 0.1, mode: toe", straight),
       "hops/dataset.yaml:10: trials[0] = (a block of keys); a straight leg neither rolls nor has "
       "another toe: its one mode is stance. Write mode: stance."},
      {of(", contact_x_m: 0.1", ball),
       "hops/dataset.yaml:10: trials[0] = (a block of keys); a ball has no stance to begin in. "
       "Begin the record in flight."},
  });
}

}  // namespace
}  // namespace hoplab
