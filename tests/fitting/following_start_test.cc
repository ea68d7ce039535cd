// Records of another engine's robot, whose modulus is stated far off.

#include "fitting/following_start.h"

#include <gtest/gtest.h>

#include "datasets/read_dataset.h"
#include "fitting/fit.h"
#include "fitting/missed_motion.h"
#include "fitting/problem.h"

namespace hoplab {
namespace {

FitProblem Robot(double of_modulus) {
  Dataset robot = ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/robot-drops");
  for (Trial& trial : robot.trials) trial.mechanism.robot.E_Pa *= of_modulus;
  return MakeProblem(robot, {});
}
Eigen::VectorXd StartOf(const FitProblem& problem) {
  return FollowingStart(problem, TrialsOf(problem, TrialRole::kTrain), InitialShared(problem), 2);
}

TEST(FollowingStart, IsWhatIsStatedWhereThatIsFollowed) {
  const FitProblem problem = Robot(1.0);
  EXPECT_EQ(StartOf(problem), InitialShared(problem));
}

TEST(FollowingStart, IsNearTheModulusThatIsThere) {
  constexpr double kThere_Pa = 22e9;
  for (const double factor : {0.08, 0.3, 3.0, 10.0}) {
    const FitProblem problem = Robot(factor);
    ASSERT_EQ(problem.shared[1].name, "E_2");
    const Eigen::VectorXd start = StartOf(problem);
    for (int leg = 0; leg < 2; ++leg) {
      EXPECT_GT(start[leg], kThere_Pa / 1.5) << factor;
      EXPECT_LT(start[leg], kThere_Pa * 1.5) << factor;
    }
    EXPECT_EQ(start[2], InitialShared(problem)[2]);
  }
}

// Where the legs give way at what is stated, no search begins there.
TEST(FollowingStart, LetsAFitBegin) {
  FitOptions options;
  options.jobs = 2;
  options.discrepancy = Discrepancy::kNone;
  const FitResult stated = Fit(Robot(1.0), options), soft = Fit(Robot(0.1), options);
  ASSERT_TRUE(stated.ok && soft.ok);
  for (int k = 0; k < stated.shared.size(); ++k)
    EXPECT_NEAR(soft.shared[k], stated.shared[k], 1e-3 * stated.shared[k]);
}

}  // namespace
}  // namespace hoplab
