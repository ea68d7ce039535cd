// docs/tutorial.md word for word: every command it shows is run by a shell in its order, and what
// the page says it prints is compared with what it prints.

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "tests/app/hoplab_process.h"

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

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

// One and a half units of the last digit of "20.74", "6e-05".
double LastDigit(const std::string& number) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  const std::size_t point = std::min(number.find('.'), e);
  const int decimals = point < e ? static_cast<int>(e - point - 1) : 0;
  const int power = e < number.size() ? std::stoi(number.substr(e + 1)) : 0;
  return 1.5 * std::pow(10.0, power - decimals);
}

// The same words, and numbers that agree to the digits shown.
bool SameLine(const std::string& shown, const std::string& printed) {
  const std::regex number("[0-9]+(\\.[0-9]+)?([eE][-+]?[0-9]+)?");
  using Iterator = std::sregex_iterator;
  Iterator a(shown.begin(), shown.end(), number), b(printed.begin(), printed.end(), number);
  const Iterator end;
  std::size_t from_a = 0, from_b = 0;
  for (; a != end && b != end; ++a, ++b) {
    const auto at_a = static_cast<std::size_t>(a->position());
    const auto at_b = static_cast<std::size_t>(b->position());
    if (shown.substr(from_a, at_a - from_a) != printed.substr(from_b, at_b - from_b)) return false;
    if (std::abs(std::stod(a->str()) - std::stod(b->str())) > LastDigit(a->str())) return false;
    from_a = at_a + a->str().size();
    from_b = at_b + b->str().size();
  }
  return a == end && b == end && shown.substr(from_a) == printed.substr(from_b);
}

// Whether `printed` is what `shown` says; "..." on a line of its own stands for any lines.
::testing::AssertionResult Matches(const std::vector<std::string>& shown,
                                   const std::vector<std::string>& printed) {
  std::size_t at = 0;
  bool any = false;
  for (const std::string& line : shown) {
    if (line.find_first_not_of(' ') != std::string::npos &&
        line.substr(line.find_first_not_of(' ')) == "...") {
      any = true;
      continue;
    }
    while (any && at < printed.size() && !SameLine(line, printed[at])) ++at;
    if (at >= printed.size() || !SameLine(line, printed[at]))
      return ::testing::AssertionFailure()
             << "the page shows\n"
             << line << "\nand the command prints\n"
             << (at < printed.size() ? printed[at] : "(nothing more)");
    ++at;
    any = false;
  }
  if (!any && at < printed.size())
    return ::testing::AssertionFailure() << "the page does not show\n" << printed[at];
  return ::testing::AssertionSuccess();
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
    std::vector<std::string> shown = Lines(block.body);
    const std::string command = shown[0].substr(2);
    shown.erase(shown.begin());
    const ProcessResult run = Shell(command);
    ++commands;
    if (shown.empty()) {
      EXPECT_EQ(run.exit_code, 0) << command << "\n" << run.out;
    } else {
      EXPECT_TRUE(Matches(shown, Lines(run.out))) << command << "\n" << run.out;
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
    EXPECT_TRUE(
        Matches(Lines(ReadText(shipped / name)), Lines(ReadText(temp_.path() / "made" / name))))
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
  EXPECT_TRUE(Matches({"a", "  ...", "d"}, {"a", "b", "c", "d"}));
  EXPECT_FALSE(Matches({"a", "d"}, {"a", "b", "d"}));
  EXPECT_FALSE(Matches({"a"}, {"a", "b"}));
  EXPECT_FALSE(Matches({"a", "b"}, {"a"}));
}

}  // namespace
}  // namespace hoplab::testing
