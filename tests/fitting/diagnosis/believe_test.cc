#include "fitting/diagnosis/believe.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "fitting/diagnosis/verdict.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::DatasetOf;
using testing::OptionsWith;

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

// A clock that does what a cause does, four nats worse, beside a model that lacks nothing else.
TEST(Believe, ARivalThatIsBehindDoesNotMakeANameUnlikelyWhereOnlyNoiseIsLeft) {
  NameFeatures f;
  f.gap = std::log1p(4.0);
  f.gain = 3.0;
  f.others = 1.0;
  const std::vector<WiderGroup> wider = {{.told = 0.98, .gap = 2000.0, .others = 1.0}};
  const double alone = GroupProbability(f, {}, true);
  EXPECT_EQ(alone, CalibratedProbability(f));
  EXPECT_LT(alone, 0.3);
  EXPECT_EQ(GroupProbability(f, wider, false), alone);
  EXPECT_GT(GroupProbability(f, wider, true), 0.9);
  EXPECT_LE(GroupProbability(f, wider, true), 0.98);
  // Part of the log odds that it adds is believed.
  NameFeatures as_part = f;
  as_part.gap = std::log1p(50.0);
  as_part.group = 1.0;
  const double best = LogOddsOf(0.98 * CalibratedProbability(as_part));
  EXPECT_NEAR(LogOddsOf(GroupProbability(f, wider, true)),
              LogOddsOf(alone) + 0.8 * (best - LogOddsOf(alone)), 1e-12);
}

// A search finds a corner of the model's error that some cause fits.
TEST(Believe, NoNameIsLikelierThanWhatItExplainsAgainstWhatNothingExplains) {
  EXPECT_NEAR(MostBelievable(0.03, 0.97), 0.03, 1e-12);
  EXPECT_NEAR(MostBelievable(0.6, 0.2), 0.75, 1e-12);
  EXPECT_EQ(MostBelievable(-0.1, 0.5), 0.0);
  EXPECT_EQ(MostBelievable(1e-4, 0.0), 1.0);  // nothing is left that the noise does not hide

  Dataset shaken = DatasetOf({});
  for (Trial& t : shaken.trials) {
    for (std::size_t i = 0; i < t.trace.time_s.size(); ++i)
      t.trace.columns[1].values[i] += 0.02 * std::sin(2.0 * M_PI * 2.5 * t.trace.time_s[i]);
  }
  const Diagnosis d = Diagnose(shaken, OptionsWith(testing::kSixEffects));
  EXPECT_EQ(NameOf(d.verdict), "unexplained") << d.reason;
  ASSERT_TRUE(d.extension);
  const ExtensionReport& e = *d.extension;
  EXPECT_GT(LeftOverNoise(d.detection, 1.0 - e.explained), 3.0);
  for (const CauseReport& c : e.causes)
    EXPECT_LE(c.group_probability,
              e.OfMisfit(c.share) / (e.OfMisfit(c.share) + 8.0 / 9.0 * (1.0 - e.explained)))
        << c.cause.Name();
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
