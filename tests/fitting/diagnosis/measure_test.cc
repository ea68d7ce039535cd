#include "fitting/diagnosis/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fitting/generate.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::EffectOfSize;
using testing::NullFit;

constexpr double kBias = 0.02;  // rad

// Three hops of two held-out trials.
testing::World Biased(std::uint64_t seed = 5) {
  return {
      .effects = {EffectOfSize("touchdown_angle_bias", kBias)}, .test = 2, .hops = 3, .seed = seed};
}

struct Compared {
  NullFit fit;
  FittedModel after;
  HeldOutErrors errors_before, errors_after;
  HeldOutGain gain;
  std::vector<std::string> left_out;

  explicit Compared(const testing::World& world) : fit(world) {
    after = fit.RefittedWith(CandidateOf("touchdown_angle_bias"));
    Compare();
  }
  void Compare() {
    errors_before = MeasureHeldOut(fit.null, 1);
    errors_after = MeasureHeldOut(after, 1);
    left_out.clear();
    gain = CompareHeldOut(fit.null, errors_before, errors_after, 1, &left_out);
  }
};

TEST(HeldOutGain, OfAModelOverItselfIsZero) {
  const NullFit fit(Biased());
  const HeldOutErrors errors = MeasureHeldOut(fit.null, 1);
  const HeldOutGain gain = CompareHeldOut(fit.null, errors, errors, 1, nullptr);
  EXPECT_EQ(gain.nats_per_sample, 0.0);
  ASSERT_TRUE(gain.ci95);
  EXPECT_EQ(gain.ci95->first, 0.0);
  EXPECT_EQ(gain.ci95->second, 0.0);
  EXPECT_FALSE(gain.IsClaim());
}

TEST(HeldOutGain, UnderWhiteNoiseIsHalfTheChiSquareSavedASampleThePriorsCounted) {
  const Compared c(Biased());
  double saved = 0.0;
  long samples = 0;
  for (std::size_t i = 0; i < c.fit.problem.trials.size(); ++i) {
    if (c.fit.problem.trials[i].role != TrialRole::kTest) continue;
    const TrialErrors &before = c.errors_before.trials[i], &after = c.errors_after.trials[i];
    saved += 0.5 * (before.chi2 - after.chi2) + before.prior_nll - after.prior_nll;
    samples += c.fit.problem.trials[i].sample_count;
  }
  EXPECT_EQ(c.gain.samples, samples);
  EXPECT_NEAR(c.gain.nats_per_sample, saved / static_cast<double>(samples), 1e-9);
}

TEST(HeldOutGain, OfTheTrueEffectMayBeClaimed) {
  const Compared c(Biased());
  EXPECT_TRUE(c.gain.IsClaim());
  EXPECT_GE(c.gain.hops, 4);
  EXPECT_TRUE(c.left_out.empty());
}

TEST(HeldOutGain, OfAnEffectThatIsNotThereIsSeldomClaimed) {
  // The interval promises 2.5 %; three or more of ten would be a chance of 0.2 %.
  int claims = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const NullFit fit({.test = 2, .hops = 3, .seed = seed});
    const FittedModel after = fit.RefittedWith(CandidateOf("touchdown_angle_bias"));
    const HeldOutGain gain =
        CompareHeldOut(fit.null, MeasureHeldOut(fit.null, 1), MeasureHeldOut(after, 1), 1, nullptr);
    claims += gain.IsClaim();
    EXPECT_NEAR(gain.nats_per_sample, 0.0, 0.05);
  }
  EXPECT_LE(claims, 2);
}

TEST(HeldOutGain, IntervalHoldsWhatOtherRecordingsOfTheTrialsGain) {
  double mean = 0.0;
  constexpr int kRecordings = 8;
  for (int i = 0; i < kRecordings; ++i)
    mean +=
        Compared(Biased(100 + static_cast<std::uint64_t>(i))).gain.nats_per_sample / kRecordings;
  const Compared c(Biased());
  ASSERT_TRUE(c.gain.ci95);
  EXPECT_LT(c.gain.ci95->first, mean);
  EXPECT_GT(c.gain.ci95->second, mean);
}

TEST(HeldOutGain, HasNoIntervalOfFewerThanFourBlocks) {
  testing::World world = Biased();
  world.test = 1;
  world.hops = 2;
  world.rate_hz = 20.0;  // a block is of ten rows at least
  const Compared c(world);
  EXPECT_LT(c.gain.blocks, 4);
  EXPECT_GT(c.gain.nats_per_sample, 0.0);
  EXPECT_FALSE(c.gain.ci95);
  EXPECT_FALSE(c.gain.IsClaim());
}

TEST(HeldOutGain, WithoutHeldOutTrialsIsNotComputed) {
  testing::World world = Biased();
  world.test = 0;
  const Compared c(world);
  EXPECT_TRUE(std::isnan(c.gain.nats_per_sample));
  EXPECT_EQ(c.gain.samples, 0);
  EXPECT_FALSE(c.gain.ci95);
}

TEST(HeldOutGain, ATrialThatCannotBeSimulatedIsLeftOutByName) {
  Compared c(Biased());
  const long samples = c.gain.samples;
  for (FittedModel* e : {&c.fit.null, &c.after})
    e->problem.trials.back().parameters.m *= 100.0;  // the leg does not carry it
  c.Compare();
  EXPECT_EQ(c.left_out, std::vector<std::string>{c.fit.problem.trials.back().file});
  EXPECT_LT(c.gain.samples, samples);
  EXPECT_GT(c.gain.samples, 0);
}

TEST(HeldOutGain, IntervalRepeatsWithTheSameSeed) {
  const Compared c(Biased());
  const HeldOutGain again = CompareHeldOut(c.fit.null, c.errors_before, c.errors_after, 1, nullptr);
  EXPECT_EQ(again.ci95, c.gain.ci95);
}

TEST(HeldOutErrors, OfTheTrueModelAreTheNoise) {
  const Compared c(Biased());
  for (double rmse : c.errors_after.test.rmse) EXPECT_NEAR(rmse, 0.001, 0.0003);
  EXPECT_GT(c.errors_before.test.rmse[0], 1.1 * c.errors_after.test.rmse[0]);
}

TEST(HeldOutErrors, ApexHeightsOfTheTrueModelAreRight) {
  const Compared c(Biased());
  EXPECT_LT(c.errors_after.features.apex_height_rmse, 0.002);
  EXPECT_LT(c.errors_after.features.apex_height_rmse, c.errors_before.features.apex_height_rmse);
  EXPECT_LT(c.errors_after.features.apex_time_rmse, c.errors_before.features.apex_time_rmse);
}

TEST(HeldOutErrors, ContactTimesAreNotComputedWithoutAContactChannel) {
  const Compared c(Biased());
  EXPECT_TRUE(std::isnan(c.errors_after.features.touchdown_time_rmse));
  EXPECT_TRUE(std::isnan(c.errors_after.features.stance_time_rmse));
}

// The contact column is as late as the other channels are, which the fit knows.
TEST(HeldOutErrors, ContactTimesAreReadAtTheInstantOfTheOtherChannels) {
  Scenario scenario = testing::HopScenario(2);
  scenario.effects = {EffectOfSize("sensor_delay", 0.03)};
  scenario.dataset->channels.push_back({Channel::kContact, {}});
  const NullFit fit(GenerateDataset(scenario, {}).dataset, {.with_effects = {"sensor_delay"}});
  const HeldOutErrors errors = MeasureHeldOut(fit.null, 1);
  EXPECT_LT(errors.features.touchdown_time_rmse, 0.003);  // rows are 4 ms apart
  EXPECT_LT(errors.features.stance_time_rmse, 0.003);
}

TEST(HeldOutErrors, DoNotDependOnTheNumberOfJobs) {
  const NullFit fit(Biased());
  EXPECT_EQ(MeasureHeldOut(fit.null, 1).test.rmse, MeasureHeldOut(fit.null, 4).test.rmse);
}

}  // namespace
}  // namespace hoplab
