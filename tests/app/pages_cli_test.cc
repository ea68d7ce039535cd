// Every command that README.md and the pages of docs/ show as `./hoplab ...` is run as it stands
// there, in its order, and what a page says it prints is compared with what it prints. (A command
// that takes too long for a test stands there as `hoplab ...`.)
#include <gtest/gtest.h>

#include <optional>
#include <regex>
#include <sstream>

#include "tests/app/hoplab_process.h"
#include "tests/app/shown_output.h"

namespace hoplab::testing {
namespace {

const std::filesystem::path kPages = HOPLAB_SOURCE_DIR;

struct ShownCall {
  std::vector<std::string> arguments;
  std::optional<std::vector<std::string>> output;  // where the page shows it
};

// Calls on an indented line, between backticks, or behind "$ " with their output; but those that
// build and test, and patterns like COMMAND.
std::vector<ShownCall> CallsOf(const std::string& page) {
  const std::regex call(
      "```text\n\\$ \\./hoplab ([^\n]+)\n([^`]*)```|(?:\n    |`)\\./hoplab ([^`#\n]+)");
  std::vector<ShownCall> calls;
  for (std::sregex_iterator it(page.begin(), page.end(), call), end; it != end; ++it) {
    const bool shown = (*it)[1].matched;
    std::istringstream words((*it)[shown ? 1 : 3].str());
    ShownCall one;
    for (std::string word; words >> word;) one.arguments.push_back(word);
    const std::string& name = one.arguments[0];
    if (name == "test" || name == "bench" || name == "COMMAND") continue;
    if (shown) one.output = ShownLines((*it)[2].str());
    calls.push_back(one);
  }
  return calls;
}

// How closely two derivatives agree is a matter of the last bits.
std::vector<std::string> WithoutLastBits(std::vector<std::string> lines) {
  for (std::string& line : lines) {
    if (line.starts_with("  gradients ")) line = line.substr(0, line.find(" to "));
  }
  return lines;
}

// The smallest dataset that a page shows, with the first columns of two recorded trials as its
// traces.
void WriteMyLeg(const std::string& page, const std::filesystem::path& folder) {
  const std::string fence = "```yaml\n# my-leg/dataset.yaml\n";
  const std::size_t begin = page.find(fence);
  if (begin == page.npos) return;
  std::filesystem::create_directory(folder);
  const std::size_t text = begin + fence.size();
  WriteText(folder / "dataset.yaml", page.substr(text, page.find("```", text) - text));
  const auto columns = [&](const std::string& from, const std::string& to) {
    std::istringstream in(ReadText(ShippedDataset("rig-drops") + "/" + from));
    std::string out;
    for (std::string line; std::getline(in, line);) {
      std::size_t at = 0;
      for (int comma = 0; comma < 3; ++comma) at = line.find(',', at + (comma > 0));
      out += line.substr(0, at) + "\n";
    }
    WriteText(folder / to, out);
  };
  columns("train-2.csv", "drop-1.csv");
  columns("test-7.csv", "drop-2.csv");
}

// Runs what a page shows, in a folder of its own.
void RunPage(const std::string& name, std::size_t least) {
  const TempFolder temp;
  for (const char* folder : {"datasets", "experiments", "docs"})
    std::filesystem::create_directory_symlink(kPages / folder, temp.path() / folder);
  const std::string page = ReadText(kPages / name);
  WriteMyLeg(page, temp.path() / "my-leg");
  const std::vector<ShownCall> calls = CallsOf(page);
  ASSERT_GE(calls.size(), least);
  for (const ShownCall& call : calls) {
    const ProcessResult run = RunHoplab(call.arguments, temp.path());
    EXPECT_EQ(run.exit_code, 0) << call.arguments[0] << ": " << run.err;
    if (!call.output) continue;
    EXPECT_TRUE(PrintsAs(WithoutLastBits(*call.output), WithoutLastBits(ShownLines(run.out))))
        << call.arguments[0] << "\n"
        << run.out;
  }
}

TEST(ReadmeCli, EveryCommandItShowsRuns) { RunPage("README.md", 3); }
TEST(PagesCli, WhatComesOutIsWhatThePageShows) { RunPage("docs/what-comes-out.md", 13); }
TEST(PagesCli, OnesOwnData) { RunPage("docs/own-data.md", 5); }
TEST(PagesCli, GaitsGainsAndSweeps) { RunPage("docs/gaits.md", 3); }
TEST(PagesCli, Installation) { RunPage("docs/install.md", 1); }
TEST(PagesCli, ThePublishedStudy) { RunPage("docs/published-study.md", 5); }

}  // namespace
}  // namespace hoplab::testing
