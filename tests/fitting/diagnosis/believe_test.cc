#include "fitting/diagnosis/believe.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;

Heterogeneity Sizes(double mean, double spread, double p_value) {
  Heterogeneity h;
  h.mean = mean;
  h.spread = spread;
  h.p_value = p_value;
  return h;
}

TEST(Disagreement, IsTheRarityTimesTheSpreadOverHalfTheSize) {
  const Candidate drag = CandidateOf("air_drag");
  EXPECT_NEAR(Disagreement(std::array{Sizes(0.02, 0.005, 0.01)}, drag), 2.0 * 0.5, 1e-12);
  EXPECT_NEAR(Disagreement(std::array{Sizes(-0.02, 0.005, 1e-9)}, drag), 3.0 * 0.5, 1e-12);
  EXPECT_NEAR(Disagreement(std::array{Sizes(0.02, 0.05, 1e-9)}, drag), 3.0, 1e-12);
  EXPECT_EQ(Disagreement(std::array{Sizes(0.02, 0.0, 1.0)}, drag), 0.0);
}

// A mass that sits 8 mm ahead, and 0.5 mm higher in one trial than in the next.
TEST(Disagreement, OfSeveralParametersIsMeasuredAgainstTheLargest) {
  const Candidate mass = CandidateOf("com_offset");
  ASSERT_EQ(mass.parameter_count(), 2);
  const double seen =
      Disagreement(std::array{Sizes(8e-3, 0.0, 1.0), Sizes(5e-4, 5e-4, 1e-6)}, mass);
  EXPECT_NEAR(seen, 3.0 * 0.5e-3 / 4e-3, 1e-12);
  EXPECT_NEAR(Disagreement(std::array{Sizes(5e-4, 0.0, 1.0), Sizes(5e-4, 5e-4, 1e-6)}, mass), 3.0,
              1e-12);
  EXPECT_NEAR(Disagreement(std::array{Sizes(0.0, 0.0, 1.0), Sizes(0.0, 5e-4, 1e-6)}, mass), 3.0,
              1e-12);
}

TEST(BelieveLessAtBound, LeavesNoNameLikelyAndTheSharesOfAGroupAsTheyAre) {
  std::vector<CauseReport> causes(2);
  causes[0].group_probability = 0.96;
  causes[0].probability = 0.72;  // three quarters of its group
  causes[1].group_probability = causes[1].probability = 0.2;
  BelieveLessAtBound(causes);
  EXPECT_LT(causes[0].group_probability, kLikely);
  EXPECT_NEAR(causes[0].probability / causes[0].group_probability, 0.75, 1e-12);
  EXPECT_EQ(causes[1].group_probability, 0.2);
  EXPECT_EQ(causes[1].probability, 0.2);
}

}  // namespace
}  // namespace hoplab
