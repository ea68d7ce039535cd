// The examples in datasets/README.md are read as they stand there.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/read_dataset.h"
#include "datasets/read_scenario.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

// The texts of the fenced blocks that begin with ```language.
std::vector<std::string> Blocks(const std::string& language) {
  const std::string readme =
      testing::ReadText(std::filesystem::path(HOPLAB_SOURCE_DIR) / "datasets" / "README.md");
  const std::string open = "```" + language + "\n";
  std::vector<std::string> blocks;
  for (std::size_t at = readme.find(open); at != readme.npos; at = readme.find(open, at)) {
    at += open.size();
    blocks.push_back(readme.substr(at, readme.find("```", at) - at));
  }
  return blocks;
}

TEST(DatasetsReadme, ItsDatasetReads) {
  ASSERT_EQ(Blocks("csv").size(), 1u);
  const Dataset dataset = ReadDatasetText(
      Blocks("yaml").at(0), {{"drop-25.csv", Blocks("csv")[0]}, {"drop-35.csv", Blocks("csv")[0]}});
  EXPECT_EQ(dataset.trials.size(), 2u);
}

TEST(DatasetsReadme, ItsScenarioReads) {
  const Scenario scenario = ScenarioDocument::FromText(Blocks("yaml").at(1), "README.md").Read();
  EXPECT_TRUE(scenario.search);
  EXPECT_TRUE(scenario.sweep);
  EXPECT_EQ(scenario.dataset->trials.size(), 3u);
}

}  // namespace
}  // namespace hoplab
