// A leg with a toe mass through the program: the shipped scenario.
#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

const std::string kScenario =
    (std::filesystem::path(HOPLAB_SOURCE_DIR) / "experiments/toe-mass.yaml").string();

class ToeMassCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  TempFolder temp_;
};

TEST_F(ToeMassCli, TheShippedScenarioRunsAndDiffersFromTheMasslessLeg) {
  const auto end_x = [&](const std::string& mass) {
    const ProcessResult run = Hoplab({"simulate", kScenario, "--json", "--set",
                                      "mechanism.toe_mass_kg=" + mass, "--sensitivities", "E"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto record = nlohmann::json::parse(run.out);
    EXPECT_EQ(record.at("outcome"), "completed");
    return record.at("final_state").at("x_m").get<double>();
  };
  EXPECT_GT(std::abs(end_x("0.02") - end_x("0")), 1e-3);
}

TEST_F(ToeMassCli, ItsMassIsSomethingToDifferentiateBy) {
  const ProcessResult run =
      Hoplab({"simulate", kScenario, "--json", "--sensitivities", "m_toe,kp_place,kd_place"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto of = nlohmann::json::parse(run.out).at("sensitivities");
  EXPECT_NE(of.at("m_toe").at("final_state").at("x_m").get<double>(), 0.0);
  const ProcessResult massless = Hoplab(
      {"simulate", kScenario, "--sensitivities", "m_toe", "--set", "mechanism.toe_mass_kg=0"});
  EXPECT_EQ(massless.exit_code, 65);
}

TEST_F(ToeMassCli, AVeryLightToeRunsWithCvodes) {
  const ProcessResult run = Hoplab({"simulate", kScenario, "--set", "mechanism.toe_mass_kg=1e-8",
                                    "--json", "--integrator", "cvodes"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out).at("outcome"), "completed");
}

TEST_F(ToeMassCli, AGaitIsRefusedWithTheReason) {
  const ProcessResult run = Hoplab({"gait", kScenario});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_NE(run.err.find("mechanism.toe_mass_kg; speed and height at an apex do not tell"),
            std::string::npos)
      << run.err;
}

TEST_F(ToeMassCli, AnEffectThatIsNotModelledThereIsRefused) {
  const ProcessResult run = Hoplab({"simulate", kScenario, "--with", "torque_lag:t_lag=0.01"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_NE(run.err.find("does not apply to a leg with a toe mass"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace hoplab::testing
