// gait: keys, verdicts, refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

// The straight leg whose steady hop and multipliers are known, started 10 % slow at that energy.
const char* const kSlip =
    "format: hoplab-scenario/1\n"
    "name: slip\n"
    "mechanism: {type: straight_leg, body_mass_kg: 100, gravity_m_per_s2: 10, leg: {rest_length_m: "
    "1, stiffness_N_per_m: 1e4, damping_N_s_per_m: 0}}\n"
    "touchdown_angle_deg: 5\n"
    "initial: {x_m: 0, y_m: 1.2408206865714297, vx_m_per_s: 0.4624254683050356, vy_m_per_s: 0}\n"
    "stop: {hops: 1}\n";

const char* const kController = "controller: {kp_N_s: 4, v_des_m_per_s: 1.8}\n";

class GaitCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  TempFolder temp_;
};

TEST_F(GaitCli, FindsTheKnownSteadyHop) {
  WriteText(temp_.path() / "slip.yaml", kSlip);
  const ProcessResult run = Hoplab({"gait", "slip.yaml", "--json", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const nlohmann::json record = nlohmann::json::parse(run.out);
  EXPECT_NEAR(record.at("fixed_point").at("vx_m_per_s").get<double>(), 0.513806075894484, 1e-9);
  EXPECT_NEAR(record.at("multipliers")[0][0].get<double>(), 4.180741, 1e-6);
  EXPECT_NEAR(record.at("multipliers")[1][0].get<double>(), 1.0, 1e-6);
  EXPECT_EQ(record.at("stable"), false);
  EXPECT_TRUE(record.at("predicted_hops").is_null());
}

TEST_F(GaitCli, TellsStabilityPredictionAndDerivatives) {
  const std::string scenario = WriteScenario(temp_.path(), kController);
  const ProcessResult run = Hoplab({"gait", scenario, "--set", "touchdown_angle_deg=40", "--set",
                                    "stop.time_s=15", "--along", "kp=3:5", "--out", "run"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("spectral radius"), std::string::npos);
  EXPECT_NE(run.out.find("along kp"), std::string::npos);
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("stable"), true);
  for (const char* name : {"E", "d", "kp", "v_des", "theta_td"})
    EXPECT_TRUE(record.at("d_spectral_radius").at(name).is_number()) << name;
  EXPECT_GE(record.at("branch").at("points").size(), 3u);
  EXPECT_TRUE(std::filesystem::exists(temp_.path() / "run" / "branch.csv"));
  EXPECT_EQ(Hoplab({"gait", scenario, "--out", "run"}).exit_code, 65) << "not overwritten";
}

TEST_F(GaitCli, ThePredictedHopsAreThoseOfTheRunFromNearby) {
  const std::string scenario = WriteScenario(temp_.path(), kController);
  const auto gait = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "gait",   scenario,         "--set", "touchdown_angle_deg=40",
        "--set",  "stop.time_s=15", "--set", "initial.y_m=0.4",
        "--json", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nlohmann::json::parse(Hoplab(arguments).out);
  };
  const nlohmann::json steady = gait({}).at("fixed_point");
  const auto set = [&](const char* key, const char* name, double factor) {
    return key + std::to_string(factor * steady.at(name).get<double>());
  };
  const nlohmann::json record = gait({"--set", set("initial.vx_m_per_s=", "vx_m_per_s", 1.06),
                                      "--set", set("initial.y_m=", "y_m", 0.97)});
  EXPECT_GE(record.at("predicted_hops"), 2);
  EXPECT_NEAR(record.at("predicted_hops").get<double>(),
              record.at("counted").at("hops").get<double>(), 1.0);
}

TEST_F(GaitCli, AHopperWithoutASteadyHopIsNoResult) {
  const std::string scenario = WriteScenario(temp_.path());
  const ProcessResult run = Hoplab({"gait", scenario, "--json", "--out", "run"});
  EXPECT_EQ(run.exit_code, 1) << "damped and without torque: nothing restores its energy";
  const nlohmann::json record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_TRUE(record.at("fixed_point").at("vx_m_per_s").is_null());
  EXPECT_TRUE(record.at("spectral_radius").is_null());
}

TEST_F(GaitCli, BadRangesAndBallsAreRefused) {
  const std::string scenario = WriteScenario(temp_.path(), kController);
  EXPECT_EQ(Hoplab({"gait", scenario, "--along", "kp"}).exit_code, 64);
  EXPECT_EQ(Hoplab({"gait", scenario, "--along", "kp=5:3"}).exit_code, 64);
  const ProcessResult misspelt = Hoplab({"gait", scenario, "--along", "kq=3:5"});
  EXPECT_EQ(misspelt.exit_code, 65);
  EXPECT_NE(misspelt.err.find("--along: kq"), std::string::npos) << misspelt.err;
  const ProcessResult start = Hoplab({"gait", scenario, "--along", "x0=-1:1"});
  EXPECT_EQ(start.exit_code, 65);
  EXPECT_NE(start.err.find("where a run starts"), std::string::npos) << start.err;
  EXPECT_EQ(Hoplab({"gait", scenario, "--along", "kp=5:6"}).exit_code, 65) << "4 lies outside";
  const ProcessResult negative = Hoplab({"gait", scenario, "--along", "kp=-1:6"});
  EXPECT_EQ(negative.exit_code, 65);
  EXPECT_NE(negative.err.find("--along: kp = -1; must be in [0, 1e6] N s"), std::string::npos)
      << negative.err;
  const ProcessResult effect = Hoplab(
      {"gait", scenario, "--with", "air_drag:c_drag=0.05", "--along", "air_drag.c_drag=-1:1"});
  EXPECT_EQ(effect.exit_code, 65);
  EXPECT_NE(effect.err.find("--along: air_drag.c_drag = -1; must be in [0, 10]"), std::string::npos)
      << effect.err;
  WriteText(temp_.path() / "ball.yaml",
            "format: hoplab-scenario/1\nname: ball\nmechanism: {type: ball, body_mass_kg: 0.2, "
            "gravity_m_per_s2: 9.81, ball: {radius_m: 0.02, restitution: 0.85, tangential_loss: "
            "0.1}}\ninitial: {x_m: 0, y_m: 1, vx_m_per_s: 1, vy_m_per_s: 0}\nstop: {hops: 3}\n");
  const ProcessResult ball = Hoplab({"gait", "ball.yaml"});
  EXPECT_EQ(ball.exit_code, 65);
  EXPECT_NE(ball.err.find("has no gait"), std::string::npos) << ball.err;
  EXPECT_EQ(CountEntries(temp_.path()), 2) << "nothing written";
}

}  // namespace
}  // namespace hoplab::testing
