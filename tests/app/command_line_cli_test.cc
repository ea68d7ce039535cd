// What every command shares: help that fits a screen, words that are nearly right, plain output.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <regex>
#include <set>
#include <sstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

constexpr std::size_t kScreenLines = 40;

std::string Spoken(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string HelpOf(const std::vector<std::string>& command, std::size_t columns) {
  ProcessRequest request{
      .command = {"/usr/bin/env", "COLUMNS=" + std::to_string(columns), HOPLAB_BINARY},
      .folder = "/"};
  request.command.insert(request.command.end(), command.begin(), command.end());
  request.command.emplace_back("--help");
  const ProcessResult run = RunProcess(request);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  return run.out;
}

// As the program's own help lists them, and the one that it hides.
std::vector<std::string> Commands() {
  const std::string help = HelpOf({}, 98);
  std::vector<std::string> names = {"man"};
  bool listed = false;
  for (const std::string& line : LinesOf(help.substr(help.find("Subcommands:")))) {
    listed = line.starts_with("  ") && line[2] != ' ';
    if (listed) names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

std::set<std::string> LongOptionsOf(const std::string& command) {
  const std::string help = HelpOf({command}, 98);
  const std::regex option("\n  (?:-h,)?(--[a-z-]+)");
  std::set<std::string> names;
  for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it)
    names.insert((*it)[1]);
  return names;
}

TEST(HelpCli, OfEveryCommandFitsAScreenWithAnExample) {
  const std::vector<std::string> commands = Commands();
  ASSERT_GE(commands.size(), 18u);
  for (const std::string& command : commands) {
    const std::string first_example = "\n  hoplab " + command;
    EXPECT_NE(HelpOf({command}, 98).find(first_example), std::string::npos) << command;
  }
  std::vector<std::vector<std::string>> calls = {{}};
  for (const std::string& command : commands) calls.push_back({command});
  for (const std::vector<std::string>& call : calls) {
    for (const std::size_t columns : {80, 98}) {
      const std::string name = call.empty() ? "hoplab" : call[0];
      const std::vector<std::string> lines = LinesOf(HelpOf(call, columns));
      EXPECT_LE(lines.size(), kScreenLines) << name << " at " << columns;
      for (const std::string& line : lines) EXPECT_LE(line.size(), columns) << name << ": " << line;
    }
  }
}

TEST(HelpCli, TheFirstExampleOfEveryCommandRuns) {
  const TempFolder temp;
  for (const char* folder : {"datasets", "docs", "experiments"})
    std::filesystem::create_directory_symlink(std::filesystem::path(HOPLAB_SOURCE_DIR) / folder,
                                              temp.path() / folder);
  std::vector<std::string> commands = Commands();
  // Of a fit the report is made anew.
  std::stable_partition(commands.begin(), commands.end(),
                        [](const std::string& command) { return command == "fit"; });
  for (const std::string& command : commands) {
    const std::string help = HelpOf({command}, 98);
    const std::regex example("\n  hoplab ([^\n>|]*)");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(help, found, example)) << command;
    const std::string call = found[1].str();
    // Half a minute; a page shows the same, and its test runs it.
    if (command == "identify") {
      const std::string page =
          ReadText(std::filesystem::path(HOPLAB_SOURCE_DIR) / "docs/published-study.md");
      EXPECT_NE(page.find("./hoplab " + call), std::string::npos) << call;
      continue;
    }
    std::istringstream words(call);
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    const ProcessResult run = RunHoplab(arguments, temp.path());
    EXPECT_EQ(run.exit_code, 0) << call << ": " << run.err;
    EXPECT_NE(run.out, "") << call;
  }
}

// ---- words that are nearly right

std::string MessageOf(const std::vector<std::string>& arguments, int exit_code,
                      const std::filesystem::path& folder) {
  const ProcessResult run = RunHoplab(arguments, folder);
  EXPECT_EQ(run.exit_code, exit_code) << Spoken(arguments) << "\n" << run.err;
  return run.err;
}

TEST(SuggestionCli, AMistypedCommandNamesTheOneMeant) {
  for (const std::string& command : Commands()) {
    std::string mistyped = command;
    std::swap(mistyped[0], mistyped[1]);
    const std::string message = MessageOf({mistyped}, 64, "/");
    EXPECT_NE(message.find("Did you mean " + command + "?"), std::string::npos) << message;
  }
}

TEST(SuggestionCli, AMistypedOptionNamesTheOneMeantInEveryCommand) {
  for (const std::string& command : Commands()) {
    for (const std::string& option : LongOptionsOf(command)) {
      const std::string mistyped = "--x" + option.substr(2);
      const std::string message = MessageOf({command, mistyped}, 64, "/");
      EXPECT_NE(message.find("Did you mean " + option + "?"), std::string::npos)
          << command << ": " << message;
    }
  }
}

TEST(SuggestionCli, WordsTooManyAreToldInTheirOrder) {
  const std::string drops = ShippedDataset("rig-drops");
  EXPECT_EQ(MessageOf({"fit", drops, "first", "second", "--zzz"}, 64, "/"),
            "hoplab fit: first, second, --zzz: these are not expected here. See hoplab fit "
            "--help.\n");
  EXPECT_EQ(MessageOf({"fit", drops, "first"}, 64, "/"),
            "hoplab fit: first: this is not expected here. See hoplab fit --help.\n");
}

struct Mistyped {
  std::vector<std::string> arguments;
  int exit_code;
  std::string meant;
};

TEST(SuggestionCli, AMistypedEffectLawKeyParameterOrValueNamesTheOneMeant) {
  const TempFolder temp;
  const std::string drops = ShippedDataset("rig-drops");
  const std::string shipped = std::string(HOPLAB_SOURCE_DIR) + "/experiments/";
  const std::string hops = shipped + "controlled-hopping.yaml", sweep = shipped + "modulus.yaml",
                    search = shipped + "fastest-convergence.yaml";
  std::vector<Mistyped> cases = {
      {{"effects", "air_drga"}, 65, "air_drag"},
      {{"effects", "--law", "consistant"}, 65, "consistent"},
      {{"explain", "air_drga"}, 65, "air_drag"},
      {{"explain", "condtion number"}, 65, "condition-number"},
      {{"explain", "consistant"}, 65, "consistent"},
      {{"completion", "bahs"}, 64, "bash"},
      {{"reproduce", "tabel-6.5"}, 65, "table-6.5"},
      {{"diagnose", drops, "--effects", "air_drga"}, 65, "air_drag"},
      {{"diagnose", drops, "--without", "air_drga"}, 65, "air_drag"},
      {{"compare", drops, "--variant", "consistant"}, 65, "consistent"},
      {{"compare", drops, "--variant", "consistent+air_drga"}, 65, "air_drag"},
      {{"fit", drops, "--profile", "EE,d"}, 65, "E"},
      {{"fit", drops, "--strategy", "growing_horizn"}, 64, "growing_horizon"},
      {{"fit", drops, "--span", "hop"}, 64, "hops"},
      {{"fit", drops, "--loss", "squard"}, 64, "squared"},
      {{"optimize", search, "--algorithm", "crs3"}, 64, "crs2"},
      {{"optimize", search, "--over", "theta_dt=0.1:0.5"}, 65, "theta_td"},
      {{"gait", hops, "--along", "theta_dt=0.5:0.9"}, 65, "theta_td"},
      {{"gait", shipped + "pronking.yaml", "--along", "clock.perod_s=0.2:0.3"},
       65,
       "clock.period_s"},
      {{"simulate", hops, "--sensitivities", "v_dse"}, 65, "v_des"},
  };
  for (const std::string command : {"check", "fit", "diagnose", "compare"}) {
    if (command != "compare") {
      cases.push_back({{command, drops, "--law", "consistant"}, 65, "consistent"});
      cases.push_back({{command, drops, "--with", "air_drga"}, 65, "air_drag"});
    }
    cases.push_back({{command, drops, "--free", "E,kpp"}, 65, "kp"});
    cases.push_back({{command, drops, "--fix", "v_dse=1"}, 65, "v_des"});
    cases.push_back({{command, drops, "--integrator", "dop835"}, 64, "dop853"});
  }
  for (const auto& [command, file] : {std::pair{"simulate", hops},
                                      {"gait", hops},
                                      {"optimize", search},
                                      {"sweep", sweep},
                                      {"generate", shipped + "three-drops.yaml"}}) {
    std::vector<std::string> begin = {command, file};
    if (std::string(command) == "generate") begin.insert(begin.end(), {"--out", "made"});
    const auto add = [&](const std::string& option, const std::string& value,
                         const std::string& meant) {
      std::vector<std::string> arguments = begin;
      arguments.insert(arguments.end(), {option, value});
      cases.push_back({arguments, 65, meant});
    };
    add("--law", "consistant", "consistent");
    add("--with", "air_drga:c_drag=1", "air_drag");
    add("--with", "air_drag:c_darg=1", "c_drag");
    add("--set", "mechanism.body_mas_kg=1", "body_mass_kg");
  }
  const std::vector<std::string> study = {"reproduce", "table-6.5", "--constants",
                                          shipped + "published.yaml"};
  for (const auto& [option, value, meant] : std::vector<std::array<std::string, 3>>{
           {"--law", "consistant", "consistent"},
           {"--set", "mechanism.body_mas_kg=1", "body_mass_kg"}}) {
    std::vector<std::string> arguments = study;
    arguments.insert(arguments.end(), {option, value});
    cases.push_back({arguments, 65, meant});
  }
  for (const Mistyped& c : cases) {
    const std::string message = MessageOf(c.arguments, c.exit_code, temp.path());
    EXPECT_NE(message.find("Did you mean " + c.meant + "?"), std::string::npos)
        << Spoken(c.arguments) << "\n"
        << message;
  }
}

TEST(SuggestionCli, ANumberOutOfItsRangeIsToldTheRange) {
  for (const std::string value : {"1", "0", "nan", "tight", "1e-15"}) {
    const std::string message = MessageOf({"diagnose", "rig-drops", "--tolerance", value}, 64, "/");
    EXPECT_NE(message.find("--tolerance: " + value + " is no number from 1e-14 to 0.001"),
              std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace hoplab::testing
