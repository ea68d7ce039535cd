#include "fitting/leg_starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

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

// An encoder that counts turns since it was switched on.
TEST(LegTurns, ColumnsThatAreWholeTurnsOffAreTold) {
  for (const char* name : {"robot-walk", "robot-drops"}) {
    Dataset robot = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/" + name);
    EXPECT_TRUE(LegTurns(MakeProblem(robot, {})).empty()) << name;
    for (Trial& trial : robot.trials)
      for (TraceColumn& column : trial.trace.columns)
        if (column.name == ChannelName(Channel::kLegAngle2))
          for (double& value : column.values) value -= 4.0 * std::numbers::pi;
    const FitProblem problem = MakeProblem(robot, {});
    const std::vector<std::string> said = LegTurns(problem);
    ASSERT_EQ(said.size(), 1U) << name;
    EXPECT_EQ(said[0].find("leg_angle_2_rad begins 2 turns below its motor's angle"), 0U);
    EXPECT_NE(said[0].find("take -12.566371 rad from that column"), std::string::npos) << said[0];
    const std::vector<std::string> warnings = DataWarnings(robot, problem);
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
      return warning.find(said[0]) != std::string::npos;
    }));
  }
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
