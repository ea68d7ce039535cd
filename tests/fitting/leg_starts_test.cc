#include "fitting/leg_starts.h"

#include <gtest/gtest.h>

#include "datasets/read_dataset.h"
#include "fitting/check.h"

namespace hoplab {
namespace {

Dataset WalkWithPhasesOffBy(double shift, std::size_t first_trial = 0) {
  Dataset walk = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/robot-walk");
  for (std::size_t i = first_trial; i < walk.trials.size(); ++i)
    for (double& phase : walk.trials[i].controller->motors->phases) phase += shift;
  return walk;
}
std::vector<std::string> LegStartsOf(const Dataset& dataset) {
  return LegStarts(MakeProblem(dataset, {}));
}

// Its clock begins where the slow piece of a turn does.
TEST(LegStarts, AClockThatIsStatedOnItsOtherPieceIsTold) {
  const Dataset walk = WalkWithPhasesOffBy(-0.02);
  const std::vector<std::string> said = LegStartsOf(walk);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].find("leg_angle_1_rad of train-1.csv begins to turn at -3 rad/s, where the "
                         "clock as stated turns it at -"),
            0U)
      << said[0];
  const std::vector<std::string> warnings = DataWarnings(walk, MakeProblem(walk, {}));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find(said[0]), std::string::npos);
}

TEST(LegStarts, NothingIsSaidOfTheSamePieceNorWithoutAClockNorOfSomeTrials) {
  EXPECT_TRUE(LegStartsOf(WalkWithPhasesOffBy(0.0)).empty());
  EXPECT_TRUE(LegStartsOf(WalkWithPhasesOffBy(0.02)).empty());
  EXPECT_TRUE(LegStartsOf(WalkWithPhasesOffBy(-0.02, 1)).empty());
  for (const char* name : {"robot-drops", "robot-pronk", "rig-drops"})
    EXPECT_TRUE(
        LegStartsOf(ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name)).empty())
        << name;
}

}  // namespace
}  // namespace hoplab
