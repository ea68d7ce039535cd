// simulate, generate and what they hand to fit and check.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

class ScenarioCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  TempFolder temp_;
};

TEST_F(ScenarioCli, WhatIsGeneratedIsFittedBack) {
  const std::string scenario = WriteScenario(temp_.path());
  ASSERT_EQ(
      Hoplab({"generate", scenario, "--noise", "0.0005", "--seed", "7", "--out", "made"}).exit_code,
      0);
  // The dataset states the truth as nominal value: the fit begins elsewhere.
  std::string yaml = ReadText(temp_.path() / "made" / "dataset.yaml");
  const std::size_t at = yaml.find("E_Pa: ");
  ASSERT_NE(at, std::string::npos) << yaml;
  yaml.replace(at, yaml.find_first_of(",\n}", at) - at, "E_Pa: 17e9");
  WriteText(temp_.path() / "made" / "dataset.yaml", yaml);
  const ProcessResult run = Hoplab({"fit", "made", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto E = nlohmann::json::parse(run.out).at("parameters")[0];
  EXPECT_EQ(E.at("initial"), 17e9);
  // Five standard errors: one seed in two million misses.
  EXPECT_NEAR(E.at("value").get<double>(), 22e9, 5.0 * E.at("std_error").get<double>());
}

TEST_F(ScenarioCli, NoiseThatNoDatasetCanStateIsRefused) {
  const std::string scenario = WriteScenario(temp_.path());
  for (const char* noise : {"nan", "inf", "1e308", "1e-160", "0", "-1", "0,001"}) {
    const ProcessResult run = Hoplab({"generate", scenario, "--noise", noise, "--out", "made"});
    EXPECT_EQ(run.exit_code, 64) << noise;
    EXPECT_NE(run.err.find("; must be "), std::string::npos) << run.err;
  }
  EXPECT_EQ(CountEntries(temp_.path()), 1);
}

TEST_F(ScenarioCli, NoiseThatTakesSamplesOutOfTheirRangeIsRefused) {
  const std::string scenario = WriteScenario(temp_.path());
  const ProcessResult given = Hoplab({"generate", scenario, "--noise", "1e8", "--out", "made"});
  EXPECT_EQ(given.exit_code, 65);
  EXPECT_NE(given.err.find("--noise: body_x_m: {sigma: 1e8}; train-1.csv would have body_x_m = "),
            std::string::npos)
      << given.err;
  const ProcessResult stated = Hoplab(
      {"generate", scenario, "--set",
       "dataset={channels: {body_y_m: {sigma: 1e8}}, trials: [{role: train}]}", "--out", "made"});
  EXPECT_EQ(stated.exit_code, 65);
  EXPECT_NE(stated.err.find("a sample must be in [-1e6, 1e6] m"), std::string::npos) << stated.err;
  EXPECT_EQ(CountEntries(temp_.path()), 1);
}

TEST_F(ScenarioCli, AChannelThatTheMechanismDoesNotHaveIsNotGenerated) {
  const std::string shipped = std::string(HOPLAB_SOURCE_DIR) + "/experiments/";
  const ProcessResult leg =
      Hoplab({"generate", shipped + "robot-drop.yaml", "--set", "mechanism.legs=[{hip_m: [0, 0]}]",
              "--set", "controller.angles_rad=[0.5]", "--set", "dataset.trials=[{role: train}]",
              "--out", "made"});
  EXPECT_EQ(leg.exit_code, 65);
  EXPECT_NE(leg.err.find("leg_angle_2_rad; is of leg 2, and the robot has 1 leg."),
            std::string::npos)
      << leg.err;
  const ProcessResult pitch =
      Hoplab({"generate", shipped + "three-drops.yaml", "--set",
              "dataset.channels.body_pitch_rad={sigma: 0.001}", "--out", "made"});
  EXPECT_EQ(pitch.exit_code, 65);
  EXPECT_NE(pitch.err.find("body_pitch_rad; no trial would have a sample of it"), std::string::npos)
      << pitch.err;
  EXPECT_EQ(CountEntries(temp_.path()), 0);
}

TEST_F(ScenarioCli, EveryCommandTakesQuiet) {
  const std::string scenario = WriteScenario(temp_.path());
  const ProcessResult run = Hoplab({"simulate", scenario, "--quiet"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(Hoplab({"generate", scenario, "--quiet", "--out", "made"}).err, "");
  EXPECT_EQ(Hoplab({"laws", "--quiet"}).exit_code, 0);
}

TEST_F(ScenarioCli, TheSameSeedGeneratesTheSameBytes) {
  const std::string scenario = WriteScenario(temp_.path());
  for (const char* out : {"a", "b"})
    ASSERT_EQ(Hoplab({"generate", scenario, "--seed", "3", "--out", out}).exit_code, 0);
  ASSERT_EQ(Hoplab({"generate", scenario, "--seed", "4", "--out", "c"}).exit_code, 0);
  const auto csv = [&](const char* out) { return ReadText(temp_.path() / out / "train-1.csv"); };
  EXPECT_EQ(csv("a"), csv("b"));
  EXPECT_NE(csv("a"), csv("c"));
  EXPECT_EQ(Hoplab({"generate", scenario, "--out", "a"}).exit_code, 65) << "not overwritten";
  EXPECT_EQ(Hoplab({"generate", scenario, "--out", "a", "--force"}).exit_code, 0);
}

TEST_F(ScenarioCli, AnEffectOnTheCommandLineChangesTheRun) {
  const std::string scenario = WriteScenario(temp_.path());
  const auto end_x = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"simulate", scenario, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult run = Hoplab(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out).at("final_state").at("x_m").get<double>();
  };
  const double still = end_x({});
  EXPECT_LT(end_x({"--with", "air_drag:c_drag=0.5"}), still);
  EXPECT_EQ(end_x({"--with", "air_drag:c_drag=0"}), still) << "a null effect changes nothing";
  EXPECT_NE(end_x({"--set", "mechanism.leg.E_Pa=20e9"}), still);
  EXPECT_NE(end_x({"--law", "consistent"}), still);
}

// What ends where it begins has no end to be differentiated.
TEST_F(ScenarioCli, ARunThatFailsAtItsStartHasNoDerivatives) {
  const std::string scenario = WriteScenario(temp_.path());
  const ProcessResult run = Hoplab({"simulate", scenario, "--set", "initial.y_m=0.02",
                                    "--sensitivities", "E,x0", "--out", "run"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_EQ(run.out.find("d end / d"), std::string::npos) << run.out;
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("outcome"), "starts_in_ground");
  EXPECT_TRUE(record.at("sensitivities").is_null()) << record.at("sensitivities");
}

TEST_F(ScenarioCli, SimulateTellsEventsEnergyAndDerivatives) {
  const std::string scenario = WriteScenario(temp_.path());
  const ProcessResult run =
      Hoplab({"simulate", scenario, "--set", "mechanism.leg.damping_N_s_per_m=0", "--sensitivities",
              "E,x0,theta_td", "--out", "run"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("touchdown"), std::string::npos);
  EXPECT_NE(run.out.find("run folder  run"), std::string::npos);
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("outcome"), "completed");
  EXPECT_GE(record.at("hops"), 1);
  ASSERT_GE(record.at("apex_energies").size(), 2u);
  const double energy = record.at("apex_energies")[0].at("energy_J");
  for (const auto& apex : record.at("apex_energies"))
    EXPECT_NEAR(apex.at("energy_J").get<double>(), energy, 1e-8 * energy);
  // Moving the start along level ground moves the end as far.
  EXPECT_NEAR(record.at("sensitivities").at("x0").at("final_state").at("x_m").get<double>(), 1.0,
              1e-9);
  EXPECT_NE(record.at("sensitivities").at("E").at("final_state").at("y_m"), 0.0);
  EXPECT_TRUE(std::filesystem::exists(temp_.path() / "run" / "trajectory.csv"));
  EXPECT_TRUE(std::filesystem::exists(temp_.path() / "run" / "events.csv"));
}

TEST_F(ScenarioCli, AStartInTheGroundIsNoResult) {
  const std::string scenario = WriteScenario(temp_.path());
  const ProcessResult run =
      Hoplab({"simulate", scenario, "--set", "initial.y_m=0.05", "--json", "--out", "run"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(run.out).at("status"), "failed");
  EXPECT_NE(run.err.find("below touch-down height"), std::string::npos);
}

TEST_F(ScenarioCli, AllIntegratorsAgree) {
  const std::string scenario = WriteScenario(temp_.path());
  std::vector<double> ends;
  for (const char* integrator : {"dop853", "erkstep", "cvodes"}) {
    const ProcessResult run = Hoplab(
        {"simulate", scenario, "--integrator", integrator, "--tolerance", "1e-11", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    ends.push_back(nlohmann::json::parse(run.out).at("final_state").at("x_m"));
  }
  EXPECT_NEAR(ends[1], ends[0], 1e-7);
  EXPECT_NEAR(ends[2], ends[0], 1e-7);
}

TEST_F(ScenarioCli, CheckWritesNothingUnlessAsked) {
  const ProcessResult run = Hoplab({"check", ShippedDataset("rig-drops")});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("train-1.csv"), std::string::npos);
  EXPECT_NE(run.out.find("sigma in the traces"), std::string::npos);
  EXPECT_EQ(CountEntries(temp_.path()), 0);
  const ProcessResult json =
      Hoplab({"check", ShippedDataset("rig-drops"), "--json", "--out", "checked"});
  EXPECT_EQ(json.out, ReadText(temp_.path() / "checked" / "run.json"));
  EXPECT_EQ(nlohmann::json::parse(json.out).at("trials").size(), 9u);
}

TEST_F(ScenarioCli, TheCataloguesAndTheVersionArePrinted) {
  EXPECT_NE(Hoplab({"laws"}).out.find("large_deflection"), std::string::npos);
  EXPECT_NE(Hoplab({"effects"}).out.find("c_drag"), std::string::npos);
  EXPECT_EQ(Hoplab({"version"}).out.substr(0, 7), "hoplab ");
  for (const char* command : {"laws", "effects", "version"}) {
    const auto record = nlohmann::json::parse(Hoplab({command, "--json"}).out);
    EXPECT_EQ(record.at("command"), command);
    EXPECT_EQ(record.at("status"), "ok");
  }
}

TEST_F(ScenarioCli, EveryCommandHasHelpWithAnExample) {
  for (const char* command : {"check", "diagnose", "fit", "gait", "optimize", "simulate", "sweep",
                              "generate", "identify", "laws", "effects", "version"}) {
    const ProcessResult run = Hoplab({command, "--help"});
    EXPECT_EQ(run.exit_code, 0) << command;
    EXPECT_NE(run.out.find(std::string("  hoplab ") + command), std::string::npos) << run.out;
  }
}

}  // namespace
}  // namespace hoplab::testing
