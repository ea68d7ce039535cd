#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

class DesignCli : public ::testing::Test {
 protected:
  ProcessResult Design(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"design", ShippedDataset("rig-drops"), "--quiet",
                                          "--budget", "70"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunHoplab(arguments, temp_.path());
  }
  nlohmann::json RecordOf(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = more;
    arguments.insert(arguments.end(), {"--json", "--out", "run", "--force"});
    const ProcessResult run = Design(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.exit_code == 0 ? nlohmann::json::parse(run.out) : nlohmann::json();
  }
  TempFolder temp_;
};

long Lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST_F(DesignCli, SharpensAValueAndWritesWhatItTried) {
  const nlohmann::json record = RecordOf({"--sharpen", "E", "--map", "4"});
  ASSERT_FALSE(record.is_null());
  EXPECT_EQ(record.at("status"), "ok");
  EXPECT_EQ(record.at("task"), "sharpen");
  const double before = record.at("sharpened").at("half_width");
  ASSERT_FALSE(record.at("designs").empty());
  const nlohmann::json& best = record.at("designs").at(0);
  EXPECT_LT(best.at("half_width"), before);
  EXPECT_NEAR(best.at("worth").get<double>(), 1.0 - best.at("half_width").get<double>() / before,
              1e-9);
  EXPECT_TRUE(best.at("settings").at("touchdown_angle_rad").is_number());
  const std::filesystem::path run = temp_.path() / "run";
  EXPECT_EQ(Lines(ReadText(run / "designs.csv")), 1 + record.at("designs_tried").get<long>());
  EXPECT_EQ(Lines(ReadText(run / "map.csv")), 1 + 3 * 16);
  EXPECT_TRUE(std::filesystem::exists(run / "report.html"));
}

TEST_F(DesignCli, TellsTwoCausesApartWithinTheSpaceAsked) {
  const nlohmann::json record =
      RecordOf({"--cause", "touchdown_loss,leg_material_damping", "--space",
                "angle=15:30,mass=0,throw=0:0.5", "--map", "0"});
  ASSERT_FALSE(record.is_null());
  EXPECT_EQ(record.at("task"), "separate");
  ASSERT_EQ(record.at("rivals").size(), 2u);
  double sum = 0.0;
  for (const nlohmann::json& rival : record.at("rivals"))
    sum += rival.at("probability").get<double>();
  EXPECT_NEAR(sum, 1.0, 1e-12);
  for (const nlohmann::json& design : record.at("designs")) {
    const nlohmann::json& settings = design.at("settings");
    EXPECT_GE(settings.at("touchdown_angle_rad").get<double>(), 15.0 / 57.29578);
    EXPECT_LE(settings.at("touchdown_angle_rad").get<double>(), 30.0 / 57.29577);
    EXPECT_EQ(settings.at("added_mass_kg"), 0.0);
    EXPECT_LE(settings.at("throw_m_per_s"), 0.5);
    EXPECT_LE(design.at("worth_bits"), record.at("entropy_bits"));
    EXPECT_EQ(design.at("by"), "refits");
  }
  EXPECT_FALSE(std::filesystem::exists(temp_.path() / "run" / "map.csv"));
}

TEST_F(DesignCli, SaysTheSameWhateverTheJobs) {
  const std::vector<std::string> task = {"--cause", "touchdown_loss", "--map", "0", "--jobs"};
  std::vector<std::string> one = task, two = task;
  one.emplace_back("1");
  two.emplace_back("2");
  const nlohmann::json a = RecordOf(one), b = RecordOf(two);
  EXPECT_EQ(a.at("designs"), b.at("designs"));
  EXPECT_EQ(a.at("rivals").at(1).at("name"), "no effect at all");
}

TEST_F(DesignCli, ASpaceInWhichNothingCanBeSimulatedIsNoResultAndSaysWhy) {
  const ProcessResult run = Design({"--sharpen", "E", "--space", "height=0.01:0.02"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_NE(run.err.find("the simulation starts below touch-down height"), std::string::npos)
      << run.err;
}

TEST_F(DesignCli, RefusesWhatItCannotDo) {
  struct Case {
    std::vector<std::string> arguments;
    int exit_code;
    const char* said;
  };
  for (const Case& c : {Case{{"--sharpen", "EE"}, 65, "Did you mean E?"},
                        {{"--cause", "air_drga"}, 65, "Did you mean air_drag?"},
                        {{"--cause", "air_drag,air_drag"}, 65, "given twice"},
                        {{"--cause", "air_drag", "--with", "air_drag"}, 65, "part of the model"},
                        {{"--sharpen", "E", "--space", "anlge=1:2"}, 65, "Did you mean angle?"},
                        {{"--sharpen", "E", "--space", "angle=50:10"}, 65, "must be a range"},
                        {{"--sharpen", "E", "--space", "gain=0:1"}, 65, "cannot be set"},
                        {{"--sharpen", "E", "--space", "angle"}, 64, "angle=10:50"},
                        {{"--sharpen", "E", "--cause", "air_drag"}, 64, "--cause"}}) {
    const ProcessResult run = Design(c.arguments);
    EXPECT_EQ(run.exit_code, c.exit_code) << run.err;
    EXPECT_NE(run.err.find(c.said), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace hoplab::testing
