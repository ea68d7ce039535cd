// The datasets in datasets/ and, where they are at hand, those that may not be part of the project.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "datasets/read_dataset.h"
#include "datasets/suspect_things.h"
#include "datasets/write_dataset.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

class ShippedDataset : public ::testing::TestWithParam<const char*> {
 protected:
  Dataset Read() const {
    return ReadDataset(fs::path(HOPLAB_SOURCE_DIR) / "datasets" / GetParam());
  }
};

TEST_P(ShippedDataset, HasTwoTrainTrialsForEachTestTrial) {
  const Dataset dataset = Read();
  const bool clocked =
      dataset.mechanism.type == MechanismKind::kRobot && dataset.name != "robot-drops";
  EXPECT_EQ(dataset.name, GetParam());
  EXPECT_EQ(dataset.trials.size(), clocked ? 6u : 9u);
  EXPECT_EQ(std::count_if(dataset.trials.begin(), dataset.trials.end(),
                          [](const Trial& trial) { return trial.role == TrialRole::kTrain; }),
            clocked ? 4 : 6);
}

TEST_P(ShippedDataset, MayBeShipped) { EXPECT_EQ(Read().source.licence, "CC0-1.0"); }

TEST_P(ShippedDataset, HasNothingSuspect) {
  EXPECT_EQ(SuspectThings(Read()), std::vector<std::string>{});
}

TEST_P(ShippedDataset, ComesBackFromTheWriterUnchanged) {
  const Dataset dataset = Read();
  std::map<std::string, std::string> files = FormatDataset(dataset);
  EXPECT_EQ(ReadDatasetText(files["dataset.yaml"], files), dataset);
}

TEST_P(ShippedDataset, HasItsTruthBesideIt) {
  EXPECT_TRUE(fs::exists(fs::path(HOPLAB_SOURCE_DIR) / "datasets" /
                         (std::string(GetParam()) + ".truth.json")));
}

INSTANTIATE_TEST_SUITE_P(All, ShippedDataset,
                         ::testing::Values("rig-drops", "rig-drops-undamped", "rig-controlled",
                                           "robot-drops", "robot-pronk", "robot-walk"),
                         [](const auto& name) {
                           std::string word = name.param;
                           std::replace(word.begin(), word.end(), '-', '_');
                           return word;
                         });

Dataset ReadExtra(const std::string& name) {
  return ReadDataset(fs::path(HOPLAB_EXTRA_DATA) / name);
}
bool HasExtra(const std::string& name) {
  return fs::exists(fs::path(HOPLAB_EXTRA_DATA) / name / "dataset.yaml");
}

TEST(RecordedDataset, TheLaminateHopperReads) {
  if (!HasExtra("laminate-hopper")) GTEST_SKIP() << "laminate-hopper is not at hand";
  const Dataset dataset = ReadExtra("laminate-hopper");
  EXPECT_EQ(dataset.mechanism.type, MechanismKind::kStraightLeg);
  EXPECT_EQ(dataset.trials.size(), 7u);
  EXPECT_EQ(SuspectThings(dataset), std::vector<std::string>{});
}

TEST(RecordedDataset, TheTableTennisBallsRead) {
  if (!HasExtra("table-tennis-even")) GTEST_SKIP() << "table-tennis-even is not at hand";
  const Dataset dataset = ReadExtra("table-tennis-even");
  EXPECT_EQ(dataset.mechanism.type, MechanismKind::kBall);
  EXPECT_EQ(dataset.trials.size(), 15u);
  EXPECT_EQ(SuspectThings(dataset), std::vector<std::string>{});
}

}  // namespace
}  // namespace hoplab
