// In what order a search works, and that it does not matter.
#include <gtest/gtest.h>

#include <algorithm>

#include "fitting/diagnosis/name.h"
#include "fitting/diagnosis/pool.h"
#include "fitting/diagnosis/refits.h"
#include "tests/support/naming.h"

namespace hoplab {
namespace {

using testing::EffectOfSize;
using testing::GroupNames;
using testing::NameIn;
using testing::NameSix;
using testing::NullFit;
using testing::ResultOf;

// A set that is asked for twice at once is one piece of work: two threads would write one model.
TEST(NameCauses, SettlesNoModelTwice) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  const std::vector<Candidate> both =
      testing::CandidatesOf({"touchdown_angle_bias", "sensor_delay"});
  const NamingOptions options{.jobs = 2};
  Naming naming;
  FillPool(naming, both, fit.Linearised(fit.settled, both), fit.train, options);
  Refits refits(fit.null, fit.settled, fit.train, options, naming);
  refits.Try({{0}});
  refits.SettleAll({{0}, {0}});
  EXPECT_EQ(naming.refits, 2) << "one trial refit and one settled";
  refits.Better({}, {{0}, {0}, {1}}, 2);
  EXPECT_TRUE(refits.Settled({1})) << "a set named twice takes one place";
  EXPECT_EQ(naming.refits, 4);
}

// The cost is that of least squares under either noise; what is promised is not.
TEST(NameCauses, RanksTheSameFitUnderItsOwnNoiseAnew) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  Naming naming;
  const std::vector<Candidate> both = testing::CandidatesOf({"air_drag", "touchdown_angle_bias"});
  FillPool(naming, both, fit.Linearised(fit.settled, both), fit.train, {});
  FittedModel own = fit.null;
  own.problem.noise = {std::vector<double>(own.problem.channels.size(), 5.0), 0.1};
  Rankings rankings(naming, fit.train, 1);
  const Ranking white = rankings.Beside({}, fit.null), under_own = rankings.Beside({}, own);
  ASSERT_EQ(white.size(), 2u);
  ASSERT_EQ(under_own.size(), 2u);
  EXPECT_EQ(white.front().place, 1);
  EXPECT_LT(under_own.front().gain, 0.5 * white.front().gain);
}

// What tells a size of its own beside a member may be all but gone beside the whole set.
TEST(NameCauses, TakesForAlikeWhatHardlyShowsBesideTheSet) {
  const Ranking without = {{9.0, 0, 100.0}, {7.0, 1, 100.0}, {5.0, 2, 100.0}, {3.0, 3, 0.0}};
  const Ranking whole = {{0.2, 2, 3.0}, {0.1, 0, 15.0}, {0.1, 1, 30.0}, {0.0, 3, 0.0}};
  EXPECT_EQ(AlikeTo(without, whole), (std::vector<int>{2, 0}));
}

// Of a batch each begins from what was settled before it, so that it does not matter which of them
// ends first.
TEST(NameCauses, SettlesABatchInAnyOrderAlike) {
  const NullFit fit(
      {.effects = {EffectOfSize("touchdown_angle_bias", 0.03), EffectOfSize("sensor_delay", 0.006),
                   EffectOfSize("air_drag", 0.05)}});
  const std::vector<Candidate> both =
      testing::CandidatesOf({"touchdown_angle_bias", "sensor_delay"});
  const auto noise_of_both = [&](const std::vector<CandidateSet>& batch) {
    Naming naming;
    FillPool(naming, both, fit.Linearised(fit.settled, both), fit.train, {});
    const NamingOptions options;
    Refits refits(fit.null, fit.settled, fit.train, options, naming);
    refits.Try({{0}, {0, 1}});
    refits.SettleAll(batch);
    return refits.At({0, 1}).problem.noise;
  };
  const NoiseModel noise = noise_of_both({{0}, {0, 1}});
  ASSERT_FALSE(noise.IsWhite());
  EXPECT_TRUE(noise == noise_of_both({{0, 1}, {0}}));
}

TEST(NameCauses, DoesNotDependOnTheNumberOfJobs) {
  const NullFit fit({.effects = {EffectOfSize("air_drag", 0.08)}});
  const Naming one = NameSix(fit, {.jobs = 1}), four = NameSix(fit, {.jobs = 4});
  EXPECT_EQ(one.best.shared, four.best.shared);
  EXPECT_EQ(one.best.cost, four.best.cost);
  EXPECT_EQ(one.groups, four.groups);
  EXPECT_EQ(one.refits, four.refits);
  ASSERT_EQ(one.candidates.size(), four.candidates.size());
  for (std::size_t i = 0; i < one.candidates.size(); ++i) {
    EXPECT_EQ(one.candidates[i].gain, four.candidates[i].gain);
    EXPECT_EQ(one.candidates[i].status, four.candidates[i].status);
  }
}

TEST(NameCauses, DoesNotDependOnTheOrderOfTheCandidates) {
  const NullFit fit({.effects = {EffectOfSize("air_drag", 0.08)}});
  std::vector<std::string> turned = testing::kSixEffects;
  std::reverse(turned.begin(), turned.end());
  const Naming there = NameSix(fit), back = NameIn(fit, testing::CandidatesOf(turned));
  EXPECT_EQ(GroupNames(there), GroupNames(back));
  EXPECT_NEAR(there.best.cost, back.best.cost, 0.01);
  for (const CandidateResult& c : there.candidates) {
    EXPECT_EQ(c.status, ResultOf(back, c.candidate.Name()).status) << c.candidate.Name();
    EXPECT_NEAR(c.gain, ResultOf(back, c.candidate.Name()).gain, 0.01) << c.candidate.Name();
  }
}

TEST(NameCauses, CountsAndReportsEveryRefit) {
  const NullFit fit({.effects = {EffectOfSize("air_drag", 0.08)}});
  int calls = 0, last = 0, planned = 0;
  NamingOptions options{.max_effects = 1};
  options.progress = [&](int refits, int of, std::string_view what) {
    ++calls;
    last = refits;
    EXPECT_GE(of, planned) << "more may follow, never less";
    planned = of;
    EXPECT_LE(refits, of);
    EXPECT_FALSE(what.empty());
  };
  const Naming n = NameSix(fit, options);
  EXPECT_EQ(calls, n.refits);
  EXPECT_EQ(last, n.refits);
  EXPECT_EQ(planned, n.refits) << "what was planned was done";
  EXPECT_GE(n.refits, 6);
}

}  // namespace
}  // namespace hoplab
