#include "fitting/design/trial_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "base/input_error.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<TrialProblem> TrainOf(const FitProblem& problem) {
  std::vector<TrialProblem> train;
  for (const TrialProblem& t : problem.trials) {
    if (t.role == TrialRole::kTrain) train.push_back(t);
  }
  return train;
}

DesignSpace SpaceOf(int hops, const ProblemOptions& options = {}) {
  const FitProblem problem = MakeProblem(testing::HopDataset(hops, 1), options);
  return DefaultSpace(problem, TrainOf(problem));
}

std::optional<DesignRange> RangeIn(const DesignSpace& space, DesignSetting setting) {
  for (const DesignRange& r : space.ranges) {
    if (r.setting == setting) return r;
  }
  return std::nullopt;
}

// A hop of a fit hop by hop begins within its trial; what is recorded next begins anew.
TEST(TrialOf, BeginsItsOwnTime) {
  const DesignSpace space = SpaceOf(2);
  TrialProblem hop = space.like;
  hop.parameters.time_origin = hop.begin_s = 0.4;
  const TrialProblem trial = TrialOf({"next", 0.4, 0.3, 1.0, {}}, hop);
  EXPECT_EQ(trial.parameters.time_origin, 0.0);
  EXPECT_EQ(trial.begin_s, 0.0);
}

TEST(DefaultSpace, ReachesSomewhatBeyondTheTrainTrials) {
  const DesignSpace space = SpaceOf(2);
  ASSERT_EQ(space.ranges.size(), 5u);
  const DesignRange angle = *RangeIn(space, DesignSetting::kAngle);
  EXPECT_NEAR(angle.low, 7.0 * kDegree, 1e-12);  // trials: 22 to 30 deg
  EXPECT_NEAR(angle.high, 45.0 * kDegree, 1e-12);
  const DesignRange speed = *RangeIn(space, DesignSetting::kSpeed);
  EXPECT_LT(speed.low, 0.0) << "a hop back is among them";
  EXPECT_NEAR(speed.high, -3.0 * speed.low, 1e-12);
  EXPECT_NEAR(RangeIn(space, DesignSetting::kMass)->high, 0.5, 1e-12);
}

TEST(DefaultSpace, HasAGainOnlyWhereThereIsAController) {
  EXPECT_FALSE(RangeIn(SpaceOf(2), DesignSetting::kGain));
  EXPECT_TRUE(RangeIn(SpaceOf(10), DesignSetting::kGain));
}

TEST(DefaultSpace, AddsNoMassWhereTheMassIsFitted) {
  ProblemOptions options;
  options.free = {"E", "m"};
  EXPECT_FALSE(RangeIn(SpaceOf(2, options), DesignSetting::kMass));
}

TEST(DesignSpace, IsSetByRangesAndHeldByValues) {
  DesignSpace space = SpaceOf(2);
  const std::vector<DesignRange> ranges = {{DesignSetting::kAngle, 0.2, 0.4},
                                           {DesignSetting::kMass, 0.1, 0.1}};
  SetRanges(space, ranges, "--space");
  EXPECT_EQ(space.Searched().size(), 4u);
  const TrialDesign design = space.At(std::vector<double>{0.5, 0.0, 0.0, 1.0});
  EXPECT_NEAR(design.touchdown_angle, 0.3, 1e-15);
  EXPECT_EQ(design.added_mass, 0.1);
  EXPECT_EQ(design.throw_speed, RangeIn(space, DesignSetting::kThrow)->high);
}

TEST(DesignSpace, RefusesWhatTheSetUpHasNotAndRangesThatCannotBe) {
  DesignSpace space = SpaceOf(2);
  for (const DesignRange& wrong : {DesignRange{DesignSetting::kGain, 0.0, 1.0},
                                   {DesignSetting::kHeight, 0.5, 0.2},
                                   {DesignSetting::kMass, -0.1, 0.2},
                                   {DesignSetting::kAngle, 0.0, 20.0}}) {
    try {
      SetRanges(space, std::vector{wrong}, "--space");
      ADD_FAILURE() << InfoOf(wrong.setting).name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.parts().place, "--space");
    }
  }
}

TEST(TrialOf, HasTheDesignsSettings) {
  const DesignSpace space = SpaceOf(2);
  TrialDesign design = space.At(std::vector<double>(5, 0.5));
  design.added_mass = 0.25;
  design.throw_speed = 0.75;
  const TrialProblem trial = TrialOf(design, space.like);
  EXPECT_EQ(trial.parameters.m, space.like.parameters.m + 0.25);
  EXPECT_EQ(trial.start[3], 0.75);
  EXPECT_EQ(trial.start[1], design.height);
  EXPECT_EQ(trial.parameters.theta_td, design.touchdown_angle);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(trial.own[k].prior_mean, trial.start[k]);
}

TEST(Describe, SaysAThrowBackWithAMass) {
  const TrialDesign design{"a.csv", 25.0 * kDegree, 0.35, -1.2, std::nullopt, 0.2, 0.5};
  EXPECT_EQ(Describe(design),
            "throw from 0.35 m at 1.2 m/s backwards and 0.5 m/s up with a touch-down angle of 25 "
            "deg and 0.2 kg added");
}

}  // namespace
}  // namespace hoplab
