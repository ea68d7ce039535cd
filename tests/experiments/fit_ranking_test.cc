#include "experiments/identification/fit_ranking.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hoplab {
namespace {

StudyFit FitOf(double misfit, LiftoffRule liftoff, bool rest_radius) {
  StudyFit fit;
  fit.misfit = misfit;
  fit.reading.liftoff = liftoff;
  if (rest_radius) fit.reading.law.rolling_radius = ThesisReading::RollingRadius::kRest;
  return fit;
}

std::vector<double> MisfitsOf(const std::vector<StudyFit>& fits) {
  std::vector<double> misfits;
  for (const StudyFit& fit : fits) misfits.push_back(fit.misfit);
  return misfits;
}

TEST(FitRanking, OrdersByMisfitAndTakesOneOfEachReading) {
  std::vector<StudyFit> fits = {
      FitOf(std::nan(""), LiftoffRule::kZeroForce, false),
      FitOf(3.0, LiftoffRule::kZeroForce, true), FitOf(1.0, LiftoffRule::kZeroForce, false),
      FitOf(2.0, LiftoffRule::kRestLength, false), FitOf(1.5, LiftoffRule::kZeroForce, false)};
  SortByMisfit(fits);
  EXPECT_TRUE(std::isnan(fits.back().misfit));
  EXPECT_EQ(MisfitsOf(Best(fits, 4)), (std::vector<double>{1.0, 1.5, 2.0, 3.0}));
  EXPECT_EQ(Best(fits, 9).size(), 5u);
  EXPECT_EQ(MisfitsOf(BestReadings(fits, 9)), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(MisfitsOf(BestReadings(fits, 2)), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(MisfitsOf(BestLaws(fits, 9)), (std::vector<double>{1.0, 3.0}));
}

}  // namespace
}  // namespace hoplab
