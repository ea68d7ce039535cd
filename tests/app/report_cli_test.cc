#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

class ReportCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  void Simulate() {
    const std::string file = WriteScenario(temp_.path());
    ASSERT_EQ(Hoplab({"simulate", file, "--out", "run"}).exit_code, 0);
  }
  TempFolder temp_;
};

TEST_F(ReportCli, RebuildsTheVeryPageThatTheRunWrote) {
  Simulate();
  const std::filesystem::path page = temp_.path() / "run" / "report.html";
  const std::string before = ReadText(page);
  EXPECT_NE(before.find("Simulation of three-hops"), std::string::npos);
  std::filesystem::remove(page);
  const ProcessResult run = Hoplab({"report", "run"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "run/report.html\n");
  EXPECT_EQ(ReadText(page), before);
  EXPECT_EQ(Hoplab({"report", "run/"}).exit_code, 0) << "over the one that is there";
}

TEST_F(ReportCli, AFolderThatIsNoRunIsRefused) {
  Simulate();
  std::filesystem::create_directory(temp_.path() / "empty");
  WriteText(temp_.path() / "foreign" / "run.json", R"({"schema": "other/2", "command": "fit"})");
  WriteText(temp_.path() / "broken" / "run.json", R"({"schema": )");
  WriteText(temp_.path() / "array" / "run.json", "[1]");
  const auto says = [&](const std::string& folder, const std::string& part) {
    const ProcessResult run = Hoplab({"report", folder});
    EXPECT_EQ(run.exit_code, 65) << folder;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(temp_.path() / folder / "report.html"));
  };
  says("absent", "has no run.json");
  says("empty", "has no run.json");
  says("foreign", "must be hoplab-run/1");
  says("broken", "no JSON object");
  says("array", "no JSON object");
  std::filesystem::remove(temp_.path() / "run" / "report.html");
  WriteText(temp_.path() / "run" / "events.csv", "a,b\n1,2,3\n");
  says("run", "events.csv:2");
  EXPECT_EQ(Hoplab({"report"}).exit_code, 64);
}

}  // namespace
}  // namespace hoplab::testing
