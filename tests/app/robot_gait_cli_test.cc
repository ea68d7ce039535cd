// gait and sweep of a robot that a clock drives: what they tell of its stride, and what they
// refuse.
#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

class RobotGaitCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  // A pronk with something else.
  ProcessResult Gait(const std::string& set) {
    return Hoplab({"gait", pronk_, "--set", set, "--json"});
  }
  ProcessResult Sweep(const std::string& scenario, const std::string& outputs) {
    return Hoplab({"sweep", scenario, "--json", "--quiet", "--set",
                   "sweep={grid: {mechanism.body_mass_kg: [3]}, outputs: [" + outputs + "]}"});
  }
  std::string pronk_ = Shipped("experiments/pronking.yaml"),
              drop_ = Shipped("experiments/robot-drop.yaml");
  TempFolder temp_;
};

TEST_F(RobotGaitCli, ASweepHasTheSteadyStrideThatGaitFinds) {
  const ProcessResult gait = Hoplab({"gait", pronk_, "--json"});
  ASSERT_EQ(gait.exit_code, 0) << gait.err;
  const auto steady = nlohmann::json::parse(gait.out).at("fixed_point");
  const ProcessResult sweep = Sweep(pronk_, "fixed_point_vx_m_per_s, fixed_point_y_m");
  ASSERT_EQ(sweep.exit_code, 0) << sweep.err;
  const auto row = nlohmann::json::parse(sweep.out).at("rows").at(0);
  EXPECT_NEAR(row.at(1).get<double>(), steady.at("vx_m_per_s").get<double>(), 1e-6);
  EXPECT_NEAR(row.at(2).get<double>(), steady.at("y_m").get<double>(), 1e-6);
}

TEST_F(RobotGaitCli, ASweepRefusesWhatARobotDoesNotHave) {
  const ProcessResult energy = Sweep(pronk_, "energy_percent");
  EXPECT_EQ(energy.exit_code, 65);
  EXPECT_NE(energy.err.find("is not told of a robot"), std::string::npos) << energy.err;
  const ProcessResult stride = Sweep(drop_, "period_s");
  EXPECT_EQ(stride.exit_code, 65);
  EXPECT_NE(stride.err.find("whose motors follow no clock"), std::string::npos) << stride.err;
}

TEST_F(RobotGaitCli, AnotherPeriodThanTheClocksIsRefused) {
  const ProcessResult gait = Gait("effects={gait_period_scale: {gamma: 0.05}}");
  EXPECT_EQ(gait.exit_code, 65);
  EXPECT_NE(gait.err.find("one period of the clock as it is stated"), std::string::npos)
      << gait.err;
  EXPECT_NE(gait.err.find("Give controller.period_s"), std::string::npos) << gait.err;
}

TEST_F(RobotGaitCli, ThePhaseOfALegThatIsNotThereIsNotFollowed) {
  const ProcessResult gait = Hoplab({"gait", pronk_, "--along", "clock.phase_3=0:0.5"});
  EXPECT_EQ(gait.exit_code, 65);
  EXPECT_NE(gait.err.find("is of a leg that this robot does not have"), std::string::npos)
      << gait.err;
}

TEST_F(RobotGaitCli, APeriodBelowZeroIsNotFollowed) {
  const ProcessResult gait = Hoplab({"gait", pronk_, "--along", "clock.period_s=-1:0.56"});
  EXPECT_EQ(gait.exit_code, 65);
  EXPECT_NE(gait.err.find("--along: clock.period_s = -1; must be in (0, 1000] s. Check the sign."),
            std::string::npos)
      << gait.err;
}

TEST_F(RobotGaitCli, AnEffectOfALegThatIsNotThereIsRefused) {
  const ProcessResult gait = Gait("effects={motor_gain_3: {gamma: 0.1}}");
  EXPECT_EQ(gait.exit_code, 65);
  EXPECT_NE(gait.err.find("is of a leg this robot does not have"), std::string::npos) << gait.err;
}

}  // namespace
}  // namespace hoplab::testing
