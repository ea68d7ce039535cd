// On a terminal: progress on a live line, colours unless they are not wanted. Elsewhere neither.
#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"
#include "tests/support/terminal_process.h"

namespace hoplab::testing {
namespace {

constexpr const char* kLine = "\r\033[K";  // back to the line's beginning, and clear it

// The sweep over the modulus, with some hundred rows more.
std::string WriteLongSweep(const std::filesystem::path& folder) {
  std::string text =
      ReadText(std::filesystem::path(HOPLAB_SOURCE_DIR) / "experiments/modulus.yaml");
  const std::size_t begin = text.find("sweep:");
  EXPECT_NE(begin, std::string::npos);
  WriteText(folder / "long.yaml", text.substr(0, begin) + R"(sweep:
  latin_hypercube: {samples: 400, ranges: {mechanism.leg.E_Pa: [20e9, 30e9]}}
  outputs: [convergence_time_s]
)");
  return "long.yaml";
}

TerminalResult OnTerminal(const std::vector<std::string>& arguments,
                          const std::filesystem::path& folder,
                          const std::vector<std::string>& environment = {}) {
  TerminalRequest request{
      .command = {"/usr/bin/env", "-u", "NO_COLOR", "-u", "COLUMNS", "TERM=xterm"},
      .folder = folder};
  request.command.insert(request.command.end(), environment.begin(), environment.end());
  request.command.emplace_back(HOPLAB_BINARY);
  request.command.insert(request.command.end(), arguments.begin(), arguments.end());
  return RunOnTerminal(request);
}

TEST(TerminalCli, LongWorkTellsRateAndTimeLeftOnOneLine) {
  const TempFolder temp;
  const TerminalResult run = OnTerminal(
      {"sweep", WriteLongSweep(temp.path()), "--out", "run", "--jobs", "1"}, temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.shown;
  const std::size_t at = run.shown.find(" left");
  ASSERT_NE(at, std::string::npos) << run.shown;
  const std::size_t begin = run.shown.rfind(kLine, at);
  ASSERT_NE(begin, std::string::npos);
  const std::string line = run.shown.substr(begin, at - begin);
  EXPECT_NE(line.find(" of 400 rows, "), std::string::npos) << line;
  EXPECT_NE(line.find("/s, "), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << "a line of its own each time";
  // Nothing of it is left on the screen before the result.
  const std::size_t result = run.shown.find("run folder");
  ASSERT_NE(result, std::string::npos);
  EXPECT_EQ(run.shown.find("left", run.shown.rfind(kLine)), std::string::npos);
}

TEST(TerminalCli, QuietPlainAndDumbTerminalsGetNoEscapeSequence) {
  const TempFolder temp;
  const std::string sweep = WriteLongSweep(temp.path());
  const TerminalResult quiet =
      OnTerminal({"sweep", sweep, "--out", "quiet", "--quiet"}, temp.path());
  EXPECT_EQ(quiet.exit_code, 0) << quiet.shown;
  EXPECT_EQ(quiet.shown.find("sweeping"), std::string::npos) << quiet.shown;
  EXPECT_EQ(quiet.shown.find('\r' + std::string("\033")), std::string::npos) << quiet.shown;

  const TerminalResult plain =
      OnTerminal({"sweep", sweep, "--out", "plain", "--plain"}, temp.path());
  EXPECT_EQ(plain.exit_code, 0) << plain.shown;
  EXPECT_EQ(plain.shown.find('\033'), std::string::npos) << plain.shown;
  EXPECT_NE(plain.shown.find("sweeping\r\n"), std::string::npos) << plain.shown;

  const TerminalResult dumb =
      OnTerminal({"sweep", sweep, "--out", "dumb"}, temp.path(), {"TERM=dumb"});
  EXPECT_EQ(dumb.exit_code, 0) << dumb.shown;
  EXPECT_EQ(dumb.shown.find('\033'), std::string::npos) << dumb.shown;
}

TEST(TerminalCli, WithoutATerminalProgressIsPlainLinesAndResultsHaveNoColour) {
  const TempFolder temp;
  const ProcessResult run =
      RunHoplab({"sweep", WriteLongSweep(temp.path()), "--out", "run"}, temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err.rfind("sweeping\n", 0), 0u) << run.err;
  EXPECT_EQ((run.out + run.err).find('\033'), std::string::npos);
  const ProcessResult quiet =
      RunHoplab({"sweep", "long.yaml", "--out", "again", "--quiet"}, temp.path());
  EXPECT_EQ(quiet.err, "");
}

TEST(TerminalCli, ColourIsThereOnATerminalAndGoneWithNoColor) {
  const std::string bold = "\033[1m", red = "\033[31m";
  const TerminalResult coloured = OnTerminal({"laws"}, "/");
  EXPECT_NE(coloured.shown.find(bold), std::string::npos);
  EXPECT_NE(OnTerminal({"lwas"}, "/").shown.find(red), std::string::npos);
  const TerminalResult without = OnTerminal({"laws"}, "/", {"NO_COLOR=1"});
  EXPECT_EQ(without.shown.find('\033'), std::string::npos) << without.shown;
  EXPECT_EQ(OnTerminal({"lwas"}, "/", {"NO_COLOR=1"}).shown.find('\033'), std::string::npos);
}

TEST(TerminalCli, TextIsWrappedToTheTerminal) {
  TerminalRequest request{
      .command = {"/usr/bin/env", "-u", "COLUMNS", "TERM=dumb", HOPLAB_BINARY, "explain", "rmse"},
      .folder = "/",
      .columns = 50};
  const std::string shown = RunOnTerminal(request).shown;
  ASSERT_NE(shown.find("Root mean square"), std::string::npos) << shown;
  std::size_t longest = 0;
  for (std::size_t begin = 0; begin < shown.size();) {
    const std::size_t end = std::min(shown.find("\r\n", begin), shown.size());
    longest = std::max(longest, end - begin);
    begin = end + 2;
  }
  EXPECT_LE(longest, 50u) << shown;
  EXPECT_GT(longest, 40u) << shown;
}

}  // namespace
}  // namespace hoplab::testing
