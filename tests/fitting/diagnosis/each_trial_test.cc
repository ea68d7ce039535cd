#include "fitting/diagnosis/each_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::DatasetOf;
using testing::EffectOfSize;

constexpr double kPositionNoise = 1e-3;  // m
// Sizes in six train trials, then in two that are held out; none of them has a trend.
constexpr double kOffByHand[] = {0.03, -0.025, 0.02, -0.03, 0.01, -0.015, 0.025, -0.02};

// Hops with an effect of another size in each trial, `in_all` beside it.
Dataset HopsWithOwn(const std::string& effect, std::span<const double> sizes,
                    const std::vector<EffectSpec>& in_all = {}) {
  const auto with = [&](double size) {
    std::vector<EffectSpec> effects = in_all;
    effects.push_back(EffectOfSize(effect, size));
    return DatasetOf({.effects = effects, .train = 6, .test = 2, .sigma_m = kPositionNoise});
  };
  Dataset all = with(sizes[0]);
  all.effects.clear();
  for (std::size_t i = 1; i < all.trials.size(); ++i) all.trials[i] = with(sizes[i]).trials[i];
  return all;
}

const CauseReport* OwnSizesTold(const Diagnosis& d) {
  if (!d.extension) return nullptr;
  for (const CauseReport& c : d.extension->causes)
    if (c.cause.each_trial) return &c;
  return nullptr;
}

// Each within its error, which is no more than `most`.
void ExpectSizes(const CauseReport& cause, std::span<const double> sizes, double most) {
  ASSERT_TRUE(cause.refitted.at(0));
  const VaryingValue& value = *cause.refitted[0];
  ASSERT_EQ(value.sizes.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(value.sizes[i], sizes[i], 4.0 * value.std_errors[i]) << i;
    EXPECT_LT(value.std_errors[i], most) << i;
  }
}

// The modulus is that of the leg, and no test error is more than the noise.
void ExpectTheRestIsRight(const Diagnosis& d, double E, double most = 0.05) {
  const auto& ci95 = d.extension->uncertainty.parameters.front().ci95;
  ASSERT_TRUE(ci95);
  EXPECT_LE(ci95->first, E);
  EXPECT_GE(ci95->second, E);
  EXPECT_LT(ci95->second - ci95->first, most * E);
  for (const double rmse : d.extension->after.test.rmse)
    EXPECT_NEAR(rmse, kPositionNoise, 0.15 * kPositionNoise);
}

const std::vector<std::string> kCauses = {"air_drag",      "constant_force",
                                          "leg_hardening", "leg_hysteresis",
                                          "leg_stiffness", "touchdown_angle_bias"};

TEST(EachTrial, AnglesSetByHandAreNamedWithTheSizeOfEach) {
  const Diagnosis d =
      Diagnose(HopsWithOwn("touchdown_angle_bias", kOffByHand), testing::OptionsWith(kCauses));
  EXPECT_EQ(d.verdict, Verdict::kNamed) << d.reason;
  const CauseReport* angle = OwnSizesTold(d);
  ASSERT_TRUE(angle);
  EXPECT_EQ(angle->cause.Name(), "touchdown_angle_bias of each trial's own size");
  EXPECT_EQ(d.extension->causes.size(), 1u);
  EXPECT_TRUE(angle->main);
  EXPECT_GT(d.extension->explained, 0.98);
  EXPECT_TRUE(d.extension->TellsSizesOf(*angle, 0));
  ExpectSizes(*angle, kOffByHand, 0.005);
  ExpectTheRestIsRight(d, 22e9);
  EXPECT_TRUE(d.own_sizes.empty());
}

TEST(EachTrial, IsFoundBesideWhatActsInAllTrials) {
  const Diagnosis d =
      Diagnose(HopsWithOwn("touchdown_angle_bias", kOffByHand, {EffectOfSize("air_drag", 0.1)}),
               testing::OptionsWith(kCauses));
  const CauseReport* angle = OwnSizesTold(d);
  ASSERT_TRUE(angle) << d.reason;
  ExpectSizes(*angle, kOffByHand, 0.005);
  ASSERT_EQ(d.naming.best.members.size(), 2u);
  EXPECT_EQ(d.naming.best.members[0].effect->info.name, "touchdown_angle_bias");
  EXPECT_EQ(d.naming.best.members[1].Name(), "air_drag");
  EXPECT_NEAR(d.naming.best.ValuesOf(1)[0], 0.1, 0.01);
  ExpectTheRestIsRight(d, 22e9);
  // One place each in all that stands beside the members.
  EXPECT_EQ(d.naming.groups.size(), 2u);
  EXPECT_EQ(d.naming.without.size(), 2u);
  for (const std::vector<FittedModel>& rivals : d.naming.rivals)
    EXPECT_EQ(rivals.front().shared, d.naming.best.shared);
}

// How stiff the legs are together is the modulus, which is fitted: their mean is none.
TEST(EachTrial, LegsThatDifferHaveOneModulusInTheMean) {
  constexpr double kGain[] = {0.06, -0.05, 0.04, -0.06, 0.03, -0.02, 0.05, -0.04};
  const Diagnosis d = Diagnose(HopsWithOwn("leg_stiffness", kGain), testing::OptionsWith(kCauses));
  const CauseReport* stiffness = OwnSizesTold(d);
  ASSERT_TRUE(stiffness) << d.reason;
  EXPECT_EQ(stiffness->cause.effect->info.name, "leg_stiffness");
  EXPECT_TRUE(stiffness->cause.mean_held);
  EXPECT_EQ(stiffness->refitted.at(0)->mean, 0.0);
  EXPECT_FALSE(stiffness->refitted[0]->ci95);
  ExpectSizes(*stiffness, kGain, 0.025);
  // Six legs that differ by 5 % tell their mean to 2 %.
  ExpectTheRestIsRight(d, 22e9, 4.0 * 0.035);
}

// What acts alike in all trials needs no sizes of their own, and nor does what the search may not
// name: one angle, or a leg's loss without its cause.
TEST(EachTrial, IsNotToldWhereTrialsAreAlike) {
  constexpr double kAlike[] = {0.02, 0.02, 0.02, 0.02, 0.02, 0.02, 0.02, 0.02};
  EXPECT_FALSE(OwnSizesTold(
      Diagnose(HopsWithOwn("touchdown_angle_bias", kAlike), testing::OptionsWith(kCauses))));
  EXPECT_FALSE(
      OwnSizesTold(Diagnose(HopsWithOwn("leg_hysteresis", kAlike),
                            testing::OptionsWith({"air_drag", "constant_force", "leg_stiffness",
                                                  "touchdown_angle_bias"}))));
}

// The same sizes, once as they come and once falling with the angle that is stated: there what is
// missing may depend on it.
TEST(EachTrial, IsNotToldWhereSizesGoWithTheSetUp) {
  constexpr double kFalling[] = {0.03, 0.02, 0.01, -0.015, -0.025, -0.03, 0.02, -0.02};
  const Diagnosis d =
      Diagnose(HopsWithOwn("touchdown_angle_bias", kFalling), testing::OptionsWith(kCauses));
  EXPECT_FALSE(OwnSizesTold(d));
}

// The air's drag is in no list: sizes that are free in each trial take up most of it, and not all.
TEST(EachTrial, IsNotToldWhereMuchIsLeft) {
  const Diagnosis d =
      Diagnose(HopsWithOwn("touchdown_angle_bias", kOffByHand, {EffectOfSize("air_drag", 0.05)}),
               testing::OptionsWith({"touchdown_angle_bias"}));
  EXPECT_EQ(d.verdict, Verdict::kUnexplained);
  EXPECT_FALSE(OwnSizesTold(d));
  EXPECT_NE(d.own_sizes.find("touchdown_angle_bias of another size in each trial would explain"),
            std::string::npos)
      << d.own_sizes;
}

TEST(EachTrial, IsNotToldOfFewTrials) {
  Dataset few = HopsWithOwn("touchdown_angle_bias", kOffByHand);
  few.trials.erase(few.trials.begin() + 4, few.trials.begin() + 6);
  EXPECT_FALSE(OwnSizesTold(Diagnose(few, testing::OptionsWith(kCauses))));
}

TEST(EachTrial, DoesNotDependOnTheNumberOfJobs) {
  DiagnosisOptions options = testing::OptionsWith(kCauses);
  const Dataset dataset = HopsWithOwn("touchdown_angle_bias", kOffByHand);
  options.fit.jobs = 1;
  const Diagnosis one = Diagnose(dataset, options);
  options.fit.jobs = 2;
  const Diagnosis two = Diagnose(dataset, options);
  ASSERT_TRUE(OwnSizesTold(one));
  EXPECT_EQ(one.naming.best.shared, two.naming.best.shared);
  EXPECT_EQ(one.naming.gaps, two.naming.gaps);
}

}  // namespace
}  // namespace hoplab
