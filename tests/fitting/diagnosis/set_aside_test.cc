#include "fitting/diagnosis/set_aside.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fitting/diagnosis/believe.h"
#include "fitting/diagnosis/null_fit.h"
#include "fitting/diagnosis/verdict.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::EffectOfSize;
using testing::NullFit;

CauseReport Cause(int candidate, bool main, double probability) {
  CauseReport c;
  c.candidate = candidate;
  c.cause = CandidateOf(testing::kSixEffects[static_cast<std::size_t>(candidate)]);
  c.main = main;
  c.probability = c.group_probability = probability;
  return c;
}

TEST(SetAside, AMainCauseThatIsUnlikelyStandsInWhereAnotherIsLikely) {
  std::vector<CauseReport> causes = {Cause(0, true, 0.97), Cause(1, true, 0.1),
                                     Cause(2, false, 0.1)};
  FindStandIns(causes);
  EXPECT_TRUE(causes[0].main);
  EXPECT_FALSE(causes[0].stands_in);
  EXPECT_FALSE(causes[1].main);
  EXPECT_TRUE(causes[1].stands_in);
  EXPECT_FALSE(causes[2].stands_in);
}

TEST(SetAside, WhereNoMainCauseIsLikelyAllStay) {
  std::vector<CauseReport> causes = {Cause(0, true, 0.4), Cause(1, true, 0.1)};
  FindStandIns(causes);
  EXPECT_TRUE(causes[0].main && causes[1].main);
}

// Only a small cause, only an unlikely one, and only beside a main one that is likely.
TEST(SetAside, DoubtfulAreSmallUnlikelyCausesBesideALikelyOne) {
  Naming naming;
  FittedModel& best = naming.best;
  for (int i = 0; i < 4; ++i) {
    naming.best_set.push_back(i);
    naming.groups.push_back({i});
    best.members.push_back(CandidateOf(testing::kSixEffects[static_cast<std::size_t>(i)]));
  }
  best.problem = Extend(best.problem, best.members);
  best.shared = Eigen::Vector4d(1.0, 2.0, 3.0, 4.0);
  ExtensionReport report;
  report.causes = {Cause(0, true, 0.97), Cause(1, true, 0.1), Cause(2, false, 0.1),
                   Cause(3, false, 0.6)};
  report.explained = 0.8;
  report.causes[2].share = 0.25;
  FindStandIns(report.causes);
  const std::vector<SetAside> doubtful = DoubtfulCorrections(report, naming);
  ASSERT_EQ(doubtful.size(), 1u);
  EXPECT_EQ(doubtful[0].candidate, 2);
  EXPECT_EQ(doubtful[0].values, Eigen::VectorXd::Constant(1, 3.0));
  EXPECT_EQ(doubtful[0].probability, 0.1);
  EXPECT_EQ(doubtful[0].of_misfit, 0.8 * 0.25);
  for (CauseReport& c : report.causes) c.group_probability = 0.4;
  EXPECT_TRUE(DoubtfulCorrections(report, naming).empty());
  EXPECT_EQ(AllCorrections(report, naming).size(), 4u);
}

// The model told without a correction is the one fitted without it from the beginning.
TEST(SetAside, TakingAMemberOutGivesTheModelThatNeverHadIt) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                 EffectOfSize("sensor_delay", 0.006)}});
  Naming n = NameCauses(fit.fits(), testing::CandidatesOf(testing::kSixEffects),
                        fit.Linearised(fit.settled, testing::CandidatesOf(testing::kSixEffects)),
                        fit.train, {});
  const Candidate delay = CandidateOf("sensor_delay"), bias = CandidateOf("touchdown_angle_bias");
  ASSERT_EQ(n.best.members, (std::vector{delay, bias}));
  const int out = n.best_set[0], kept = n.best_set[1];
  const double was = n.best.cost;
  // As if a third one did as well in its place.
  const int third = (std::max(out, kept) + 1) % static_cast<int>(n.candidates.size());
  n.groups[0] = {out, third};
  n.candidates[static_cast<std::size_t>(third)].status = CandidateStatus::kIndistinguishable;
  ASSERT_TRUE(
      TakeOut({{out, delay, n.best.ValuesOf(0), 0.01, 0.01, 0.1}}, fit.problem, fit.Settings(), n));
  EXPECT_EQ(n.best.members, std::vector{bias});
  EXPECT_EQ(n.best_set, CandidateSet{kept});
  EXPECT_EQ(n.groups.size(), 1u);
  EXPECT_EQ(n.groups[0].front(), kept);
  EXPECT_EQ(n.gaps.size(), 1u);
  ASSERT_EQ(n.without.size(), 1u);
  EXPECT_TRUE(n.without[0].members.empty());
  EXPECT_NEAR(n.without[0].cost, fit.settled.cost, 1e-3 * fit.settled.cost);
  EXPECT_GT(n.best.cost, was + 10.0);
  EXPECT_NEAR(n.best.cost, fit.RefittedWith(bias).cost, 1e-3 * n.best.cost);
  EXPECT_TRUE(n.best.settled);
  for (const int i : {out, third})
    EXPECT_EQ(n.candidates[static_cast<std::size_t>(i)].status, CandidateStatus::kNotNeeded);
  EXPECT_EQ(n.candidates[static_cast<std::size_t>(kept)].status, CandidateStatus::kSupported);
}

// Where nothing is told, the model without causes is.
TEST(SetAside, TakingAllOutLeavesTheModelWithoutCauses) {
  const NullFit fit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}});
  Naming n = NameCauses(fit.fits(), testing::CandidatesOf(testing::kSixEffects),
                        fit.Linearised(fit.settled, testing::CandidatesOf(testing::kSixEffects)),
                        fit.train, {});
  ASSERT_EQ(n.best_set.size(), 1u);
  const int named = n.best_set[0];
  SetAside member;
  member.candidate = named;
  member.group_probability = 0.3;
  TakeAllOut({member}, fit.settled, n);
  EXPECT_DOUBLE_EQ(n.unlisted_probability, 0.7);
  EXPECT_TRUE(n.best.members.empty());
  EXPECT_EQ(n.best.cost, fit.settled.cost);
  EXPECT_TRUE(n.best_set.empty() && n.groups.empty() && n.rivals.empty() && n.gaps.empty());
  EXPECT_EQ(n.candidates[static_cast<std::size_t>(named)].status, CandidateStatus::kNotNeeded);
}

TEST(SetAside, AModelWithItIsNoLikelierThanItsName) {
  const auto odds = [](double log_odds, double probability) {
    OtherModel other;
    other.candidate = 3;
    other.log_odds = log_odds;
    std::vector<OtherModel> models = {other};
    Doubt({{3, CandidateOf("air_drag"), {}, 0.0, 0.0, probability}}, models);
    return models.empty() ? -std::numeric_limits<double>::infinity() : models[0].log_odds;
  };
  EXPECT_NEAR(odds(20.0, 0.2), std::log(0.25), 1e-12);
  EXPECT_EQ(odds(-2.0, 0.2), -2.0);                 // less likely by the data alone
  EXPECT_TRUE(std::isinf(odds(20.0, 0.9 / 20.0)));  // ruled out
  // What does as well in its place shares what is left of the group.
  OtherModel rival;
  rival.candidate = 4;
  rival.log_odds = 20.0;
  std::vector<OtherModel> models = {rival};
  Doubt({{3, CandidateOf("air_drag"), {}, 0.0, 0.0, 0.2, 0.3, 0.0, {}, {3, 4}}}, models);
  ASSERT_EQ(models.size(), 1u);
  EXPECT_NEAR(models[0].log_odds, std::log(0.1 / 0.9), 1e-12);
  EXPECT_FALSE(std::isinf(odds(20.0, 1.1 / 20.0)));
  // However sure its name was: what the whole trials do not confirm is no likelier than the rest.
  SetAside unconfirmed{3, CandidateOf("air_drag"), {}, 0.0, 0.0, 0.99};
  models[0].candidate = 3;
  models[0].log_odds = 20.0;
  Doubt({unconfirmed}, models);
  EXPECT_NEAR(models[0].log_odds, std::log(99.0), 1e-9);
  unconfirmed.by_whole_trials = Eigen::VectorXd::Zero(1);
  Doubt({unconfirmed}, models);
  EXPECT_EQ(models[0].log_odds, 0.0);
}

// Drag that hardly shows, of several sizes: where shorter parts were seen to be sound, what even
// odds would tell is told no more, and what is sure is told as before.
TEST(SetAside, WhatShowsLateAloneIsNotToldAtEvenOdds) {
  DiagnosisOptions options;
  options.candidates.only = testing::kSixEffects;
  int even = 0, sure = 0;
  for (const double drag : {0.002, 0.003, 0.004, 0.005, 0.006, 0.008}) {
    const Dataset hops =
        testing::DatasetOf({.effects = {EffectOfSize("air_drag", drag)}, .rate_hz = 800.0});
    const auto diagnosed = [&](const Beforehand& beforehand) {
      DatasetFit null = FitPlain(MakeProblem(hops, options.problem), options, Segmentation::kWhole);
      return DiagnoseFitted(std::move(null), options, beforehand);
    };
    const Diagnosis at_once = diagnosed({});
    if (!at_once.extension) continue;
    const Diagnosis late = diagnosed({.nothing_seen = true});
    const double told = at_once.extension->ToldProbability();
    const double over_noise = MisfitOverNoise(at_once.detection);
    std::printf("  drag %.3f: %.2f of the noise, P %.2f\n", drag, over_noise, told);
    if (told >= kProbable) {
      EXPECT_TRUE(late.extension) << drag;
      ++sure;
    } else if (over_noise < kSlight) {
      EXPECT_FALSE(late.extension) << drag;
      EXPECT_EQ(late.verdict, Verdict::kAdequate) << drag;
      EXPECT_TRUE(late.ShowsLateAlone()) << drag;
      EXPECT_NE(late.reason.find("late alone, as a model's own error does"), std::string::npos);
      ++even;
    }
  }
  EXPECT_GE(even, 1);
  EXPECT_GE(sure, 1);
}

}  // namespace
}  // namespace hoplab
