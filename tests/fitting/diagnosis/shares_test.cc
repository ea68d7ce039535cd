#include "fitting/diagnosis/shares.h"

#include <gtest/gtest.h>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

enum class Gain { kNone, kUnclear, kClear };  // on held-out trials: not measured, about zero, above

HeldOutGain GainOf(Gain gain) {
  HeldOutGain g;
  if (gain == Gain::kUnclear) g.ci95 = {-0.02, 0.04};
  if (gain == Gain::kClear) g.ci95 = {0.01, 0.04};
  return g;
}

struct MainCauseCase {
  double share, error_grows;
  Gain gain;
  bool is_main;
};

TEST(IsMainCause, AtBothSidesOfEachBound) {
  const MainCauseCase cases[] = {
      // Confirmed by its gain: 2 % of the misfit, or an error a tenth larger.
      {0.020, 1.00, Gain::kClear, true},
      {0.019, 1.00, Gain::kClear, false},
      {0.000, 1.11, Gain::kClear, true},
      {0.000, 1.10, Gain::kClear, false},
      // Confirmed by an error a quarter larger, if it explains 2 %.
      {0.020, 1.26, Gain::kUnclear, true},
      {0.020, 1.25, Gain::kUnclear, false},
      {0.019, 1.26, Gain::kUnclear, false},
      {0.019, 3.00, Gain::kUnclear, false},
      {0.900, 1.25, Gain::kUnclear, false},
      // Nothing could be measured that might confirm it.
      {0.020, 1.00, Gain::kNone, true},
      {0.019, 1.00, Gain::kNone, false},
      {0.000, 1.11, Gain::kNone, true},
      {0.000, 1.10, Gain::kNone, false},
  };
  for (const MainCauseCase& c : cases)
    EXPECT_EQ(IsMainCause(c.share, c.error_grows, GainOf(c.gain)), c.is_main)
        << c.share << ", " << c.error_grows << ", " << static_cast<int>(c.gain);
}

TEST(IsMainCause, TheMaterialShareIsWhatWasAskedFor) {
  EXPECT_TRUE(IsMainCause(0.05, 1.0, GainOf(Gain::kClear), 0.05));
  EXPECT_FALSE(IsMainCause(0.049, 1.0, GainOf(Gain::kClear), 0.05));
  EXPECT_FALSE(IsMainCause(0.049, 1.3, GainOf(Gain::kUnclear), 0.05));
}

// An interval that touches zero claims nothing.
TEST(IsMainCause, AGainMustBeAboveZero) {
  HeldOutGain gain;
  gain.ci95 = {0.0, 0.04};
  EXPECT_FALSE(IsMainCause(0.5, 1.0, gain));
}

// Such a refit has ended in the wrong place: the plain model is a model without the cause, too.
TEST(TakeApart, ACauseExplainsNoMoreThanAllOfTheMisfit) {
  const testing::NullFit fit({.effects = {testing::EffectOfSize("touchdown_angle_bias", 0.03)}});
  const std::vector<Candidate> candidates = testing::CandidatesOf(testing::kSixEffects);
  Naming naming = NameCauses(fit.fits(), candidates, fit.Linearised(fit.settled, candidates),
                             fit.train, NamingOptions());
  ASSERT_EQ(naming.without.size(), 1u);
  naming.without.front().cost = 100.0 * fit.null.cost;
  const HeldOutErrors after = MeasureHeldOut(naming.best, 1);
  const std::vector<CauseReport> causes = TakeApart(naming,
                                                    {.plain_square = 2.0 * fit.null.cost,
                                                     .extended_square = 2.0 * naming.best.cost,
                                                     .after = &after},
                                                    fit.Settings());
  EXPECT_DOUBLE_EQ(causes.front().share, 1.0);
}

}  // namespace
}  // namespace hoplab
