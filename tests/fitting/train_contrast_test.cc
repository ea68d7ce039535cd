// Trials that were fitted and are missed by far more than those held out.
#include "fitting/train_contrast.h"

#include <gtest/gtest.h>

#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

struct FittedRig {
  FittedRig()
      : problem(
            MakeProblem(ReadDataset(std::string(HOPLAB_SOURCE_DIR) + "/datasets/rig-drops"), {})),
        fit(Fit(problem, {})) {}
  TrainContrast Compared() const {
    return CompareRoles(problem, fit, AssessTrials(problem, fit, {}), {});
  }
  FitProblem problem;
  FitResult fit;
};

TEST(TrainContrast, OfASoundFitNothingIsFar) {
  const TrainContrast contrast = FittedRig().Compared();
  EXPECT_FALSE(contrast.IsFar());
  EXPECT_EQ(contrast.Fault() + contrast.Warning(), "");
}

// A search that has not found the start of a trial ended at no minimum.
TEST(TrainContrast, AStartThatWasNotFoundIsAFault) {
  FittedRig rig;
  rig.fit.initial_states[2][1] += 0.02;
  const TrainContrast contrast = rig.Compared();
  ASSERT_EQ(contrast.better_elsewhere.size(), 1U);
  EXPECT_EQ(contrast.better_elsewhere[0], "train-3.csv");
  EXPECT_NE(contrast.Fault().find("another start follows far better in train-3.csv"),
            std::string::npos)
      << contrast.Fault();
}

}  // namespace
}  // namespace hoplab
