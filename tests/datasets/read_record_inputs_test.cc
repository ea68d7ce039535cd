// Columns of a log that drive the simulation, and clocks of sensors. Read, written back, and
// refused with place and remedy.

#include <gtest/gtest.h>

#include "base/units.h"
#include "datasets/read_record.h"
#include "tests/datasets/recorded_hops.h"

namespace hoplab {
namespace {

using namespace testing;

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

TEST(Inputs, ATorqueMayBeOfStancesAlone) {
  const auto with = [](const char* inputs) {
    return RecordWith("trials:", std::string("inputs: ") + inputs + "\ntrials:");
  };
  const Dataset dataset = with("{hip_torque_N_m: {hold: stance}}");
  EXPECT_TRUE(dataset.trials[0].inputs[0].held);
  EXPECT_TRUE(dataset.trials[0].inputs[0].of_stance);
  ExpectRoundTrip(dataset);
  const std::string error =
      InputErrorOf([&] { with("{body_force_x_N: {column: command, hold: stance}}"); });
  EXPECT_NE(error.find("is for hip_torque_N_m alone"), std::string::npos) << error;
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
       "hops/dataset.yaml:9: inputs.hip_torque_N_m.hold = next; must be one of linear, previous, "
       "stance. "
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

}  // namespace
}  // namespace hoplab
