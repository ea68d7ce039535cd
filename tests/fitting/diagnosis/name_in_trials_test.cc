// What is there in one trial alone, in all of them, or in both coordinates.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fitting/diagnosis/in_some_trials.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/pool.h"
#include "tests/support/naming.h"

namespace hoplab {
namespace {

using testing::EffectOfSize;
using testing::GroupNames;
using testing::MembersOf;
using testing::NameIn;
using testing::NameSix;
using testing::NullFit;

TEST(NameCauses, AnEffectInOneTrialIsNamedAsSuch) {
  Dataset d = testing::DatasetOf({});
  d.trials[1] =
      testing::DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}).trials[1];
  const Naming n = NameSix(NullFit(d));
  ASSERT_FALSE(n.groups.empty());
  EXPECT_EQ(MembersOf(n), std::vector<std::string>{"touchdown_angle_bias in train-2.csv"});
  EXPECT_NEAR(n.best.ValuesOf(0)[0], 0.03, 0.005);
}

// In all trials alike it is their modulus, which is fitted.
TEST(NameCauses, ASofterLegInOneTrialIsNamedAsSuch) {
  const std::vector<Candidate> candidates =
      testing::CandidatesOf({"leg_stiffness", "leg_hardening", "touchdown_angle_bias"});
  Dataset d = testing::DatasetOf({});
  d.trials[1] = testing::DatasetOf({.effects = {EffectOfSize("leg_stiffness", -0.14)}}).trials[1];
  const Naming n = NameIn(NullFit(d), candidates);
  EXPECT_EQ(MembersOf(n), std::vector<std::string>{"leg_stiffness in train-2.csv"});
  EXPECT_NEAR(n.best.ValuesOf(0)[0], -0.14, 0.02);
  EXPECT_TRUE(
      MembersOf(NameIn(NullFit({.effects = {EffectOfSize("leg_stiffness", -0.14)}}), candidates))
          .empty());
}

// What acts in all of them hides it: in the model without that no cause in one trial promises half
// of the misfit.
TEST(NameCauses, ASofterLegInOneTrialIsFoundBesideALargerCauseInAll) {
  const std::vector<Candidate> candidates = testing::CandidatesOf(
      {"leg_material_damping", "leg_stiffness", "leg_hardening", "touchdown_loss",
       "hip_coulomb_friction", "air_drag", "touchdown_angle_bias"});
  const EffectSpec damping = EffectOfSize("leg_material_damping", 8e-4);
  Dataset d = testing::DatasetOf({.effects = {damping}, .train = 6});
  d.trials[2] =
      testing::DatasetOf({.effects = {damping, EffectOfSize("leg_stiffness", -0.06)}, .train = 6})
          .trials[2];
  const NullFit fit(d);
  const Naming found = NameIn(fit, candidates);
  EXPECT_EQ(MembersOf(found),
            (std::vector<std::string>{"leg_material_damping", "leg_stiffness in train-3.csv"}));

  const auto looked_for = [&](const FittedModel& model, std::vector<int> places) {
    Naming naming;
    FillPool(naming, candidates, fit.Linearised(fit.null, candidates), fit.train,
             {.in_some_trials = false});
    const Linearisation at =
        LineariseAt(model, CandidatesAt(naming, places), fit.train, /*jobs=*/1);
    const double left = 0.5 * (at.chi2() - at.degrees_of_freedom());
    AddInSomeTrials(naming, at, places, fit.train, 0.5 * left);
    return naming.candidates;
  };
  EXPECT_EQ(looked_for(fit.null, {0, 1, 2, 3, 4, 5, 6}).size(), candidates.size());
  const Naming in_all = NameIn(fit, candidates, {.max_effects = 1, .in_some_trials = false});
  ASSERT_EQ(MembersOf(in_all), std::vector<std::string>{"leg_material_damping"});
  FittedModel with_damping = in_all.best;
  with_damping.problem.noise = fit.null.problem.noise;
  const std::vector<CandidateResult> beside = looked_for(with_damping, {1, 2, 3, 4, 5, 6});
  ASSERT_GT(beside.size(), candidates.size());
  EXPECT_EQ(beside[candidates.size()].candidate.Name(), "leg_stiffness in train-3.csv");
}

// Six trials, the cause in some of them.
Dataset InSome(const EffectSpec& effect, const std::vector<std::size_t>& trials) {
  Dataset d = testing::DatasetOf({.train = 6});
  const Dataset with = testing::DatasetOf({.effects = {effect}, .train = 6});
  for (const std::size_t i : trials) d.trials[i] = with.trials[i];
  return d;
}

TEST(NameCauses, OneCauseInSeveralTrialsIsNamedOnce) {
  const std::vector<Candidate> candidates =
      testing::CandidatesOf({"leg_stiffness", "leg_hardening", "touchdown_angle_bias",
                             "ground_slope", "sensor_offset_y"});
  const Naming crack =
      NameIn(NullFit(InSome(EffectOfSize("leg_stiffness", -0.12), {2, 5})), candidates);
  EXPECT_EQ(MembersOf(crack),
            std::vector<std::string>{"leg_stiffness in train-3.csv and train-6.csv"});
  EXPECT_NEAR(crack.best.ValuesOf(0)[0], -0.12, 0.02);
  const Naming slope =
      NameIn(NullFit(InSome(EffectOfSize("ground_slope", 0.015), {0, 3, 4})), candidates);
  EXPECT_EQ(MembersOf(slope),
            std::vector<std::string>{"ground_slope in train-1.csv, train-4.csv and train-5.csv"});
  EXPECT_NEAR(slope.best.ValuesOf(0)[0], 0.015, 0.003);
}

// What E stands for in all trials may be in the one half of them or in the other: both are named,
// softer or stiffer.
TEST(NameCauses, OfHalfTheTrialsEitherHalfMayHaveAnotherStiffness) {
  const std::vector<Candidate> candidates =
      testing::CandidatesOf({"leg_stiffness", "leg_hardening", "touchdown_angle_bias"});
  for (const double gain : {-0.12, 0.12}) {
    Dataset d = testing::DatasetOf({.train = 4});
    const Dataset with =
        testing::DatasetOf({.effects = {EffectOfSize("leg_stiffness", gain)}, .train = 4});
    for (const std::size_t i : {1, 3}) d.trials[i] = with.trials[i];
    std::vector<std::string> names = GroupNames(NameIn(NullFit(d), candidates));
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"leg_stiffness in train-1.csv and train-3.csv",
                                               "leg_stiffness in train-2.csv and train-4.csv"}))
        << gain;
  }
}

// Sizes that are all other ones are no two groups of trials.
TEST(NameCauses, SizesThatDifferInEachTrialAreNotLaidToSome) {
  const std::vector<Candidate> candidates = testing::CandidatesOf({"ground_slope", "air_drag"});
  Dataset d = testing::DatasetOf({.train = 6});
  for (std::size_t i = 0; i < 6; ++i) {
    const double size = 0.004 * static_cast<double>(i) - 0.008;
    d.trials[i] =
        testing::DatasetOf({.effects = {EffectOfSize("ground_slope", size)}, .train = 6}).trials[i];
  }
  const Naming n = NameIn(NullFit(d), candidates);
  EXPECT_FALSE(MembersOf(n).empty());
  for (const CandidateResult& c : n.candidates)
    EXPECT_LE(c.candidate.only_recordings.size(), 1U) << c.candidate.Name();
}

// One trial, or all: whatever else would do as well has its picking to pay for.
TEST(LogOdds, ArePaidForThePickingOfTrials) {
  Naming naming;
  naming.log_odds = 3.0;
  naming.recordings = 6;
  Candidate c(FindEffect("air_drag"));
  EXPECT_DOUBLE_EQ(naming.LogOdds(c), 3.0);
  c.only_recordings = {"a"};
  EXPECT_DOUBLE_EQ(naming.LogOdds(c), 3.0 + std::log(6.0));
  c.only_recordings = {"a", "b"};
  EXPECT_DOUBLE_EQ(naming.LogOdds(c), 3.0 + std::log(6.0 * 15.0));
}

TEST(NameCauses, AScaleOfThePictureIsNoPairOfScales) {
  const Naming n = NameIn(NullFit({.effects = {EffectOfSize("camera_scale", 0.02)}}),
                          testing::CandidatesOf({"camera_scale", "sensor_scale_x", "sensor_scale_y",
                                                 "clock_scale", "rest_radius_scale"}));
  EXPECT_EQ(MembersOf(n), std::vector<std::string>{"camera_scale"});
  EXPECT_NEAR(n.best.ValuesOf(0)[0], 0.02, 0.004);
}

TEST(NameCauses, AnEffectInEveryTrialIsNotLaidToOne) {
  const Naming n = NameSix(NullFit({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}));
  for (const std::string& name : GroupNames(n))
    EXPECT_EQ(name.find(" in "), std::string::npos) << name;
}

}  // namespace
}  // namespace hoplab
