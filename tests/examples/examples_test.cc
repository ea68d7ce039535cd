// The programs of examples/, run as examples/README.md says: each prints what stands there.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <sstream>

#include "tests/support/run_process.h"

namespace hoplab::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = HOPLAB_SOURCE_DIR;

// A block of the page: the call behind `$ `, and what it prints.
struct Shown {
  std::vector<std::string> call;
  std::string output;
};

std::vector<Shown> ShownCalls() {
  const std::string page = ReadText(kSource / "examples/README.md"), begin = "```text\n$ ";
  std::vector<Shown> shown;
  for (std::size_t at = page.find(begin); at != page.npos; at = page.find(begin, at)) {
    at += begin.size();
    const std::size_t line = page.find('\n', at), end = page.find("```", line);
    std::istringstream words(page.substr(at, line - at));
    Shown one{{}, page.substr(line + 1, end - line - 1)};
    for (std::string word; words >> word;) one.call.push_back(word);
    shown.push_back(one);
    at = end;
  }
  return shown;
}

bool IsPython(const Shown& shown) { return shown.call.front() == "python3"; }

// The file that a call runs: "hop.cc", "fit_table.py".
std::string FileOf(const Shown& shown) {
  return IsPython(shown) ? fs::path(shown.call[1]).filename().string()
                         : shown.call.front().substr(2) + ".cc";
}

void PrintTo(const Shown& shown, std::ostream* out) { *out << FileOf(shown); }

// Whether `printed` is the text shown, in which a line `...` stands for any others.
bool Matches(const std::string& shown, const std::string& printed) {
  const std::size_t gap = shown.find("...\n");
  if (gap == shown.npos) return printed == shown;
  return printed.starts_with(shown.substr(0, gap)) && printed.ends_with(shown.substr(gap + 4)) &&
         printed.size() >= shown.size() - 4;
}

class Examples : public ::testing::TestWithParam<Shown> {};

TEST_P(Examples, PrintsWhatThePageShows) {
  const Shown& shown = GetParam();
  std::vector<std::string> command;
  if (IsPython(shown)) {
#ifdef HOPLAB_PYTHON
    command = {"/usr/bin/env", "PYTHONPATH=" HOPLAB_BUILD_DIR "/python", HOPLAB_PYTHON, "-B"};
#else
    GTEST_SKIP() << "the Python module is not built";
#endif
  } else {
    command = {HOPLAB_BUILD_DIR "/examples/" + shown.call.front().substr(2)};
  }
  command.insert(command.end(), shown.call.begin() + 1, shown.call.end());
  const ProcessResult run = RunProcess({.command = command, .folder = kSource});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(Matches(shown.output, run.out)) << run.out << "instead of\n" << shown.output;
}

INSTANTIATE_TEST_SUITE_P(All, Examples, ::testing::ValuesIn(ShownCalls()), [](const auto& info) {
  std::string name = FileOf(info.param);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

TEST(ExamplesPage, ShowsEveryFileAndNoFileIsLong) {
  std::vector<std::string> shown;
  for (const Shown& one : ShownCalls()) shown.push_back(FileOf(one));
  int files = 0;
  for (const auto& entry : fs::directory_iterator(kSource / "examples")) {
    const std::string extension = entry.path().extension();
    if (extension != ".cc" && extension != ".py") continue;
    ++files;
    const std::string name = entry.path().filename(), text = ReadText(entry.path());
    EXPECT_EQ(std::count(shown.begin(), shown.end(), name), 1) << name;
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 60) << name;
  }
  EXPECT_GE(files, 8);
}

}  // namespace
}  // namespace hoplab::testing
