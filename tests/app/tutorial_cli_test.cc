// docs/tutorial.md word for word: every command it shows is run by a shell in its order, and what
// the page says it prints is compared with what it prints.

#include <gtest/gtest.h>

#include <regex>

#include "tests/app/hoplab_process.h"
#include "tests/app/shown_output.h"

namespace hoplab::testing {
namespace {

namespace fs = std::filesystem;

struct Block {
  std::string info, body;  // "text", "yaml guide-rig/dataset.yaml"
};

std::vector<Block> BlocksOf(const std::string& markdown) {
  std::vector<Block> blocks;
  const std::regex fence("```([^\n]*)\n([^`]*)```|\n    ([^\n]*)");
  for (std::sregex_iterator it(markdown.begin(), markdown.end(), fence), end; it != end; ++it) {
    // An indented line is a command of which nothing is shown.
    const bool indented = (*it)[3].matched;
    blocks.push_back({(*it)[1].str(), indented ? "$ " + (*it)[3].str() + "\n" : (*it)[2].str()});
  }
  return blocks;
}

class TutorialCli : public ::testing::Test {
 protected:
  TutorialCli() {
    fs::create_directory_symlink(fs::path(HOPLAB_SOURCE_DIR) / "docs", temp_.path() / "docs");
    fs::create_symlink(HOPLAB_BINARY, temp_.path() / "hoplab");
  }
  ProcessResult Shell(const std::string& command) {
    return RunProcess(
        {.command = {"/bin/bash", "-c",
                     "export HOPLAB=" + std::string(HOPLAB_BINARY) + "; exec 2>&1; " + command},
         .folder = temp_.path()});
  }
  TempFolder temp_;
};

TEST_F(TutorialCli, EveryCommandPrintsWhatThePageShows) {
  int commands = 0;
  for (const Block& block :
       BlocksOf(ReadText(fs::path(HOPLAB_SOURCE_DIR) / "docs" / "tutorial.md"))) {
    if (block.info.starts_with("yaml ")) {
      WriteText(temp_.path() / block.info.substr(5), block.body);
      continue;
    }
    ASSERT_TRUE(block.body.starts_with("$ ")) << block.body;
    std::vector<std::string> shown = ShownLines(block.body);
    const std::string command = shown[0].substr(2);
    shown.erase(shown.begin());
    const ProcessResult run = Shell(command);
    ++commands;
    if (shown.empty()) {
      EXPECT_EQ(run.exit_code, 0) << command << "\n" << run.out;
    } else {
      EXPECT_TRUE(PrintsAs(shown, ShownLines(run.out))) << command << "\n" << run.out;
    }
  }
  EXPECT_GE(commands, 9);

  // The cause in the record, too, and the truth within the intervals.
  const nlohmann::json why = ReadRecord(temp_.path() / "runs" / "guide-rig-why");
  EXPECT_EQ(why.at("verdict"), "named");
  EXPECT_EQ(why.at("cause"), "guide_coulomb_friction");
  const nlohmann::json fit = ReadRecord(temp_.path() / "runs" / "guide-rig-with-friction");
  const std::map<std::string, double> truth = {
      {"E", 21e9}, {"d", 2.0}, {"guide_coulomb_friction.f_c", 0.4}};
  for (const auto& parameter : fit.at("parameters")) {
    const double value = truth.at(parameter.at("name"));
    EXPECT_LT(parameter.at("ci95").at(0).get<double>(), value) << parameter;
    EXPECT_GT(parameter.at("ci95").at(1).get<double>(), value) << parameter;
  }
}

TEST_F(TutorialCli, TheShippedLogsAreThoseThatItsScriptMakes) {
  const ProcessResult run = Shell("docs/tutorial/make-logs made");
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const fs::path shipped = fs::path(HOPLAB_SOURCE_DIR) / "docs" / "tutorial";
  for (int i = 1; i <= 6; ++i) {
    const std::string name = "run-" + std::to_string(i) + ".csv";
    EXPECT_TRUE(PrintsAs(ShownLines(ReadText(shipped / name)),
                         ShownLines(ReadText(temp_.path() / "made" / name))))
        << name;
  }
}

TEST(TutorialComparison, TellsOtherDigitsOtherWordsAndOtherLines) {
  EXPECT_TRUE(SameLine("  E  20.74  GPa", "  E  20.74  GPa"));
  EXPECT_TRUE(SameLine("  E  20.74  GPa", "  E  20.75  GPa"));
  EXPECT_FALSE(SameLine("  E  20.74  GPa", "  E  20.76  GPa"));
  EXPECT_FALSE(SameLine("  E  20.74  GPa", "  E  20.74  MPa"));
  EXPECT_FALSE(SameLine("  d  -291", "  d  291"));
  EXPECT_TRUE(SameLine("beyond 6e-05 rad", "beyond 7e-05 rad"));
  EXPECT_FALSE(SameLine("beyond 6e-05 rad", "beyond 6e-04 rad"));
  EXPECT_TRUE(PrintsAs({"a", "  ...", "d"}, {"a", "b", "c", "d"}));
  EXPECT_FALSE(PrintsAs({"a", "d"}, {"a", "b", "d"}));
  EXPECT_FALSE(PrintsAs({"a"}, {"a", "b"}));
  EXPECT_FALSE(PrintsAs({"a", "b"}, {"a"}));
}

}  // namespace
}  // namespace hoplab::testing
