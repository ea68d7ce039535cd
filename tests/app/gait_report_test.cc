// What the report of a gait says of a run that was stopped.
#include "app/reports/gait_report.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/support/controlled_hopper.h"

namespace hoplab {
namespace {

TEST(GaitReport, OfAnInterruptedRunTellsDerivativesThatWereNotComputed) {
  const std::atomic<bool> stop = true;
  const GaitRun run = RunGait(testing::ControlledHopper(), {.stop = &stop});
  ASSERT_TRUE(run.point.found());
  EXPECT_EQ(run.Failure(), "interrupted; what was not computed yet is left out");
  const std::string text = GaitReport("hopper", run, false);
  EXPECT_NE(text.find("not computed"), std::string::npos) << text;
  EXPECT_EQ(text.find("does not exist"), std::string::npos) << text;
}

}  // namespace
}  // namespace hoplab
