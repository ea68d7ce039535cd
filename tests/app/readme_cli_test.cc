// Every command that the root README shows is run as it stands there, in its order.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

std::string Readme() { return ReadText(std::filesystem::path(HOPLAB_SOURCE_DIR) / "README.md"); }

// Arguments of every `./hoplab ...` that stands on an indented line or between backticks, but those
// that build and test, and patterns like COMMAND.
std::vector<std::vector<std::string>> Commands() {
  const std::string text = Readme();
  const std::regex call("(?:\n    |`)\\./hoplab ([^`#\n]+)");
  std::vector<std::vector<std::string>> commands;
  for (std::sregex_iterator it(text.begin(), text.end(), call), end; it != end; ++it) {
    std::istringstream words((*it)[1].str());
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    if (arguments[0] == "test" || arguments[0] == "bench" || arguments[0] == "COMMAND") continue;
    commands.push_back(arguments);
  }
  return commands;
}

// The README's smallest dataset, with the first columns of two recorded trials as its traces.
void WriteMyLeg(const std::filesystem::path& folder) {
  const std::string text = Readme();
  const std::size_t begin = text.find("```yaml\n") + 8;
  WriteText(folder / "dataset.yaml", text.substr(begin, text.find("```", begin) - begin));
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

TEST(ReadmeCli, EveryCommandItShowsRuns) {
  const TempFolder temp;
  for (const char* folder : {"datasets", "experiments", "docs"})
    std::filesystem::create_directory_symlink(std::filesystem::path(HOPLAB_SOURCE_DIR) / folder,
                                              temp.path() / folder);
  std::filesystem::create_directory(temp.path() / "my-leg");
  WriteMyLeg(temp.path() / "my-leg");
  const std::vector<std::vector<std::string>> commands = Commands();
  ASSERT_GE(commands.size(), 7u);
  for (const std::vector<std::string>& arguments : commands) {
    const ProcessResult run = RunHoplab(arguments, temp.path());
    EXPECT_EQ(run.exit_code, 0) << arguments[0] << ": " << run.err;
  }
}

TEST(CompareCli, PrintsEveryLawAgainstTheTruth) {
  const TempFolder temp;
  const ProcessResult run =
      RunHoplab({"compare", ShippedDataset("rig-drops"), "--true", "E=21.991e9"}, temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* law : {"large_deflection", "consistent", "no_slip", "thesis"})
    EXPECT_NE(run.out.find(law), std::string::npos) << law;
  EXPECT_NE(run.out.find("(+4."), std::string::npos) << run.out;
}

TEST(CompareCli, TheElasticaWithItsLegsDampingAndMassBringsTheModulusWithinOnePercent) {
  const TempFolder temp;
  const ProcessResult run = RunHoplab({"compare", ShippedDataset("rig-drops"), "--variant",
                                       "elastica+leg_material_damping+leg_mass", "--json"},
                                      temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json row = nlohmann::json::parse(run.out).at("rows").at(0);
  // E I of the rig, by its truth file: 2.69101 N m^2, with the dataset's section 21.991 GPa.
  EXPECT_NEAR(row.at("parameters").at("E").get<double>() / 21.991e9, 1.0, 0.01);
  for (const char* channel : {"body_x_m", "body_y_m"})
    EXPECT_LT(row.at("test_rmse").at(channel).get<double>(), 0.0006) << channel;
}

}  // namespace
}  // namespace hoplab::testing
