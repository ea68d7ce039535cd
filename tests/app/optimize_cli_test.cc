#include <gtest/gtest.h>

#include <csignal>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

class OptimizeCli : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteScenario(temp_.path(),
                  "controller: {kp_N_s: 4, v_des_m_per_s: 1.8}\n"
                  "search:\n"
                  "  over: {touchdown_angle_deg: [15, 60], controller.kp_N_s: [0.5, 12]}\n"
                  "  objective: convergence_time\n"
                  "  constraints: {min_speed_m_per_s: 0.5}\n"
                  "  budget: 40\n");
  }
  // On a run of 6 s, which settles.
  ProcessResult Optimize(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"optimize", "hops.yaml", "--set", "stop.time_s=6"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunHoplab(arguments, temp_.path());
  }
  TempFolder temp_;
};

TEST_F(OptimizeCli, FindsGainsAndSaysHowSureTheyAre) {
  const ProcessResult run = Optimize({"--seeds", "2", "--map", "4", "--out", "run"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* word : {"before", "best", "how sure", "25 starts", "0.5 deg noise"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word;
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("status"), "ok");
  EXPECT_EQ(record.at("algorithm"), "direct_l");
  EXPECT_LE(record.at("evaluations"), 80);
  const nlohmann::json& best = record.at("best");
  EXPECT_GT(best.at("convergence_time_s"), 0.0);
  EXPECT_EQ(best.at("objective"), best.at("convergence_time_s"));
  EXPECT_TRUE(best.at("spectral_radius").is_number());
  const double angle = best.at("parameters").at("touchdown_angle_deg");
  EXPECT_GE(angle, 15.0);
  EXPECT_LE(angle, 60.0);
  EXPECT_FALSE(record.at("history").empty());
  EXPECT_TRUE(record.at("history").back().at("objective").is_number());
  EXPECT_EQ(record.at("robustness").at("best").at("starts").at("runs"), 25);
  EXPECT_TRUE(std::filesystem::exists(temp_.path() / "run" / "history.csv"));
  const std::string map = ReadText(temp_.path() / "run" / "map.csv");
  EXPECT_EQ(std::count(map.begin(), map.end(), '\n'), 17) << "a header and 4 x 4 cells";
}

TEST_F(OptimizeCli, OverNarrowsAndWidensTheSearch) {
  const ProcessResult run =
      Optimize({"--over", "kp,v_des=1:2", "--seeds", "1", "--map", "0", "--json", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const nlohmann::json parameters = nlohmann::json::parse(run.out).at("best").at("parameters");
  EXPECT_EQ(parameters.size(), 2u);
  EXPECT_TRUE(parameters.contains("controller.kp_N_s"));
  EXPECT_TRUE(parameters.contains("controller.v_des_m_per_s"));
}

TEST_F(OptimizeCli, WhatCannotBeSearchedIsRefused) {
  EXPECT_EQ(Optimize({"--over", "kp=5:3"}).exit_code, 64);
  EXPECT_EQ(Optimize({"--over", "v_des"}).exit_code, 65) << "no range";
  EXPECT_EQ(Optimize({"--over", "kp,kp"}).exit_code, 65);
  EXPECT_EQ(Optimize({"--algorithm", "magic"}).exit_code, 64);
  const ProcessResult constraint = Optimize({"--set", "search.constraints.min_sped_m_per_s=1"});
  EXPECT_EQ(constraint.exit_code, 65);
  EXPECT_NE(constraint.err.find("min_speed_m_per_s"), std::string::npos) << constraint.err;
  const ProcessResult stride = Optimize({"--set", "search.constraints.min_flight_share=0.1"});
  EXPECT_EQ(stride.exit_code, 65);
  EXPECT_NE(stride.err.find("is that of a robot's stride"), std::string::npos) << stride.err;
  const ProcessResult flexure =
      Optimize({"--set", "law=elastica", "--set", "search.constraints.max_flexure=0.2"});
  EXPECT_EQ(flexure.exit_code, 65);
  EXPECT_NE(flexure.err.find("law large_deflection"), std::string::npos) << flexure.err;
  EXPECT_EQ(Optimize({"--set", "search=null"}).exit_code, 65);
  EXPECT_EQ(CountEntries(temp_.path()), 1);
}

TEST_F(OptimizeCli, AConstraintIsZeroOrMore) {
  for (const char* value : {"-1", "-1e-3", "nan", ".inf", "1e300"}) {
    const ProcessResult run =
        Optimize({"--set", std::string("search.constraints.max_torque_N_m=") + value});
    EXPECT_EQ(run.exit_code, 65) << value << run.err;
    EXPECT_NE(run.err.find("search.constraints.max_torque_N_m = "), std::string::npos) << run.err;
  }
  EXPECT_EQ(CountEntries(temp_.path()), 1);
  EXPECT_EQ(Optimize({"--set", "search.constraints.min_speed_m_per_s=0", "--seeds", "1", "--map",
                      "0", "--json"})
                .exit_code,
            0);
}

TEST_F(OptimizeCli, AConstraintNothingMeetsIsNoResult) {
  const ProcessResult run = Optimize(
      {"--set", "search.constraints.min_speed_m_per_s=50", "--seeds", "1", "--map", "0", "--json"});
  EXPECT_EQ(run.exit_code, 1);
  const nlohmann::json record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_TRUE(record.at("best").is_null());
}

TEST_F(OptimizeCli, AnInterruptKeepsWhatWasFound) {
  ProcessRequest request{
      .command = {HOPLAB_BINARY, "optimize", "hops.yaml", "--set", "stop.time_s=6", "--budget",
                  "100000000", "--seeds", "1", "--map", "0", "--out", "run"},
      .folder = temp_.path()};
  request.signal = SIGINT;
  request.signal_after = "searching";
  const ProcessResult run = RunProcess(request);
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_NE(run.err.find("interrupted"), std::string::npos) << run.err;
  EXPECT_EQ(ReadRecord(temp_.path() / "run").at("status"), "failed");
}

}  // namespace
}  // namespace hoplab::testing
