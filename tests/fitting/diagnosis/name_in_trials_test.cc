// What is there in one trial alone, in all of them, or in both coordinates.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fitting/diagnosis/in_one_trial.h"
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
             {.in_one_trial = false});
    const Linearisation at =
        LineariseAt(model, CandidatesAt(naming, places), fit.train, /*jobs=*/1);
    const double left = 0.5 * (at.chi2() - at.degrees_of_freedom());
    AddInOneTrial(naming, at, places, fit.train, 0.5 * left);
    return naming.candidates;
  };
  EXPECT_EQ(looked_for(fit.null, {0, 1, 2, 3, 4, 5, 6}).size(), candidates.size());
  const Naming in_all = NameIn(fit, candidates, {.max_effects = 1, .in_one_trial = false});
  ASSERT_EQ(MembersOf(in_all), std::vector<std::string>{"leg_material_damping"});
  FittedModel with_damping = in_all.best;
  with_damping.problem.noise = fit.null.problem.noise;
  const std::vector<CandidateResult> beside = looked_for(with_damping, {1, 2, 3, 4, 5, 6});
  ASSERT_GT(beside.size(), candidates.size());
  EXPECT_EQ(beside[candidates.size()].candidate.Name(), "leg_stiffness in train-3.csv");
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
