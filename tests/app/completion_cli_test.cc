// The completion scripts, as the shells themselves use them, and the manual page.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "tests/app/hoplab_process.h"
#include "tests/support/terminal_process.h"

namespace hoplab::testing {
namespace {

using Words = std::set<std::string>;

Words CompletionsOf(const std::string& text) {
  std::istringstream in(text);
  Words lines;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) lines.insert(line);
  }
  return lines;
}

std::string OutputOf(const std::vector<std::string>& arguments) {
  const ProcessResult run = RunHoplab(arguments, "/");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.out;
}

class CompletionCli : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* shell : {"bash", "zsh", "fish"})
      WriteText(temp_.path() / shell, OutputOf({"completion", shell}));
    std::filesystem::create_directory(temp_.path() / "drops");
    WriteText(temp_.path() / "drops.yaml", "");
  }

  std::string RunShell(const std::string& program, const std::string& script) const {
    const ProcessResult run =
        RunProcess({.command = {program, "-c", script}, .folder = temp_.path()});
    EXPECT_EQ(run.exit_code, 0) << script << "\n" << run.err;
    EXPECT_EQ(run.err, "") << script;
    return run.out;
  }

  // What bash offers for the last of these words.
  Words Bash(const std::vector<std::string>& words) const {
    std::string script = "source ./bash\nCOMP_WORDS=(hoplab";
    for (const std::string& word : words) script += " '" + word + "'";
    script += ")\nCOMP_CWORD=" + std::to_string(words.size()) +
              "\n$(complete -p hoplab | sed 's/.*-F \\([^ ]*\\) .*/\\1/')\n"
              "printf '%s\\n' \"${COMPREPLY[@]}\"";
    return CompletionsOf(RunShell("/bin/bash", script));
  }

  Words Fish(const std::string& line) const {
    Words words;
    for (const std::string& offered :
         CompletionsOf(RunShell("/usr/bin/fish", "source ./fish; complete -C '" + line + "'")))
      words.insert(offered.substr(0, offered.find('\t')));
    return words;
  }

  TempFolder temp_;
};

// Commands and options as help shows them.
Words OffersOf(const std::vector<std::string>& command, const std::string& pattern) {
  std::vector<std::string> arguments = command;
  arguments.emplace_back("--help");
  const std::string help = OutputOf(arguments);
  const std::size_t begin = command.empty() ? help.find("Subcommands:") : help.find("Options:");
  const std::regex word(pattern);
  Words found;
  for (std::sregex_iterator it(help.begin() + static_cast<long>(begin), help.end(), word), end;
       it != end; ++it)
    found.insert((*it)[1]);
  return found;
}
Words CommandNames() { return OffersOf({}, "\n  ([a-z]+) "); }
Words OptionsOf(const std::string& command) {
  return OffersOf({command}, "\n  (?:-h,)?(--[a-z-]+)");
}

TEST_F(CompletionCli, BashOffersEveryCommandAndEveryOptionOfEach) {
  Words first = CommandNames();
  ASSERT_GE(first.size(), 17u);
  first.insert({"--help", "--version"});
  EXPECT_EQ(Bash({""}), first);
  EXPECT_EQ(Bash({"gen"}), Words{"generate"});
  for (const std::string& command : CommandNames())
    EXPECT_EQ(Bash({command, "--"}), OptionsOf(command)) << command;
  EXPECT_EQ(Bash({"fit", "drops", "--inte"}), Words{"--integrator"});
}

TEST_F(CompletionCli, BashOffersLawsEffectsParametersChoicesAndFiles) {
  EXPECT_EQ(Bash({"fit", "--law", "c"}), Words{"consistent"});
  EXPECT_EQ(Bash({"fit", "--law", "=", "c"}), Words{"consistent"}) << "--law=c, as bash cuts it";
  EXPECT_EQ(Bash({"fit", "--law", "="}).size(), 8u);
  EXPECT_EQ(Bash({"fit", "--with", "air_drag,torque_la"}), Words{"air_drag,torque_lag"});
  EXPECT_EQ(Bash({"fit", "--integrator", ""}), (Words{"dop853", "erkstep", "cvodes"}));
  EXPECT_EQ(Bash({"fit", "--fix", "kp"}), (Words{"kp=", "kp_place="}));
  EXPECT_EQ(Bash({"optimize", "--algorithm", "crs"}), Words{"crs2"});
  EXPECT_EQ(Bash({"simulate", "--with", "air"}), Words{"air_drag:c_drag="});
  EXPECT_EQ(Bash({"reproduce", "table-6.5", "claim-h", "kin"}), Words{"kinematics"});
  EXPECT_EQ(Bash({"explain", "spec"}), Words{"spectral-radius"});
  EXPECT_EQ(Bash({"simulate", "dro"}), (Words{"drops", "drops.yaml"})) << "a file";
  EXPECT_EQ(Bash({"fit", "dro"}), Words{"drops"}) << "a folder";
  EXPECT_EQ(Bash({"fit", "--starts", ""}), Words{}) << "a number";
}

TEST_F(CompletionCli, FishOffersTheSame) {
  EXPECT_EQ(Fish("hoplab "), CommandNames());
  for (const std::string& command : CommandNames())
    EXPECT_EQ(Fish("hoplab " + command + " --"), OptionsOf(command)) << command;
  EXPECT_EQ(Fish("hoplab fit --law c"), Words{"consistent"});
  EXPECT_EQ(Fish("hoplab fit --law=c"), Words{"--law=consistent"});
  EXPECT_EQ(Fish("hoplab fit --with air_drag,torque_la"), Words{"air_drag,torque_lag"});
  EXPECT_EQ(Fish("hoplab fit dro"), Words{"drops/"});
  EXPECT_EQ(Fish("hoplab simulate dro"), (Words{"drops/", "drops.yaml"}));
}

// zsh completes only where somebody types.
TEST_F(CompletionCli, ZshOffersTheSame) {
  const auto completed = [&](const std::string& typed, const std::string& expected) {
    const TerminalResult run = RunOnTerminal(
        {.command = {"/usr/bin/env", "TERM=dumb", "PS1=ready> ", "/usr/bin/zsh", "-f", "-i"},
         .folder = temp_.path(),
         .typed = "autoload -Uz compinit; compinit -D -u; source ./zsh; PS1='go'\n" + typed + "\t",
         .typed_after = "ready> ",
         .until = expected,
         .timeout = std::chrono::seconds(20)});
    return run.shown;
  };
  for (const auto& [typed, expected] : std::vector<std::pair<std::string, std::string>>{
           {"hoplab gen", "hoplab generate "},
           {"hoplab fit --inte", "hoplab fit --integrator "},
           {"hoplab fit --law cons", "hoplab fit --law consistent "},
           {"hoplab fit --with air_drag,torque_la", "hoplab fit --with air_drag,torque_lag"},
           {"hoplab explain spec", "hoplab explain spectral-radius "},
           {"hoplab fit dro", "hoplab fit drops/"}}) {
    const std::string shown = completed(typed, expected);
    EXPECT_NE(shown.find(expected), std::string::npos) << shown;
  }
}

TEST_F(CompletionCli, TheManualPageHasNoWarningAndTellsEveryOption) {
  WriteText(temp_.path() / "hoplab.1", OutputOf({"man"}));
  const ProcessResult checked = RunProcess(
      {.command = {"/usr/bin/env", "LC_ALL=C.UTF-8", "MANROFFSEQ=", "MANWIDTH=80", "/usr/bin/man",
                   "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", "hoplab.1"},
       .folder = temp_.path()});
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_EQ(checked.err, "");
  const ProcessResult page = RunProcess(
      {.command = {"/usr/bin/env", "LC_ALL=C.UTF-8", "MANWIDTH=80",
                   "MAN_KEEP_FORMATTING=", "/usr/bin/man", "-P", "/bin/cat", "-l", "hoplab.1"},
       .folder = temp_.path()});
  for (const std::string& command : CommandNames()) {
    EXPECT_NE(page.out.find("hoplab " + command), std::string::npos) << command;
    for (const std::string& option : OptionsOf(command))
      EXPECT_NE(page.out.find(option), std::string::npos) << command << " " << option;
  }
}

}  // namespace
}  // namespace hoplab::testing
