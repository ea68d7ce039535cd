// Causes that first parts of the trials told and that the whole trials do not confirm.
#include "fitting/diagnosis/unconfirmed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fitting/diagnosis/believe.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::DatasetOf;
using testing::EffectOfSize;
using testing::OptionsWith;

// A diagnosis of first parts that told `names`, and the same model of the whole trials. All values
// are 1 with an error of 0.1, by the whole trials of 0.05.
struct Told {
  Diagnosis first;
  CarriedOn whole;

  explicit Told(const std::vector<std::string>& names) {
    Naming& naming = first.naming;
    FittedModel& best = naming.best;
    first.extension.emplace();
    for (const std::string& name : names) {
      const int candidate = static_cast<int>(best.members.size());
      best.members.push_back(CandidateOf(name));
      naming.best_set.push_back(candidate);
      naming.groups.push_back({candidate});
      CauseReport cause;
      cause.candidate = candidate;
      cause.cause = best.members.back();
      cause.main = true;
      cause.group_probability = cause.probability = 0.97;
      cause.share = 0.25;
      first.extension->causes.push_back(cause);
    }
    first.extension->explained = 0.8;
    best.problem = Extend(best.problem, best.members);
    best.shared = Eigen::VectorXd::Ones(best.problem.shared_count());
    whole.model = best;
    ParameterUncertainty error;
    error.std_error = 0.1;
    first.extension->uncertainty.parameters.assign(static_cast<std::size_t>(best.shared.size()),
                                                   error);
    error.std_error = 0.05;
    whole.uncertainty.parameters.assign(static_cast<std::size_t>(best.shared.size()), error);
  }

  SizeChange ChangeOf(std::size_t cause) const {
    return ChangeOfSize(first.extension->causes[cause], first, whole);
  }
};

TEST(Unconfirmed, SizesDifferByErrorsOfTheirDifference) {
  Told told({"air_drag"});
  told.whole.model.shared[0] = 0.6;
  EXPECT_NEAR(told.ChangeOf(0).std_errors, 0.4 / std::sqrt(0.1 * 0.1 - 0.05 * 0.05), 1e-12);
  EXPECT_NEAR(told.ChangeOf(0).share, 0.4, 1e-12);
  EXPECT_TRUE(told.ChangeOf(0).IsPlain());
  // The error between trials counts where it is larger.
  told.first.extension->uncertainty.parameters[0].std_error_between_trials = 0.2;
  EXPECT_NEAR(told.ChangeOf(0).std_errors, 0.4 / std::sqrt(0.2 * 0.2 - 0.05 * 0.05), 1e-12);
  EXPECT_FALSE(told.ChangeOf(0).IsPlain());
  // No difference is known better than to half of the first error.
  told.whole.uncertainty.parameters[0].std_error = 0.3;
  EXPECT_NEAR(told.ChangeOf(0).std_errors, 0.4 / 0.1, 1e-12);
}

TEST(Unconfirmed, ABetterSizeIsNoOtherSize) {
  Told told({"air_drag"});
  told.first.extension->uncertainty.parameters[0].std_error = 0.01;
  told.whole.uncertainty.parameters[0].std_error = 0.001;
  told.whole.model.shared[0] = 0.9;  // by ten errors and a tenth
  EXPECT_GT(told.ChangeOf(0).std_errors, 9.0);
  EXPECT_FALSE(told.ChangeOf(0).IsPlain());
}

// A mass 8 mm ahead and at its height, 0.5 mm off by the whole trials.
TEST(Unconfirmed, AChangeIsMeasuredAgainstTheLargestValueOfItsCause) {
  Told told({"com_offset"});
  told.first.naming.best.shared << 0.008, 0.0;
  told.whole.model.shared << 0.008, 0.0005;
  for (ParameterUncertainty& u : told.first.extension->uncertainty.parameters) u.std_error = 1e-5;
  for (ParameterUncertainty& u : told.whole.uncertainty.parameters) u.std_error = 5e-6;
  EXPECT_NEAR(told.ChangeOf(0).share, 0.0005 / 0.008, 1e-12);
  EXPECT_FALSE(told.ChangeOf(0).IsPlain());
  told.whole.model.shared[1] = 0.004;
  EXPECT_TRUE(told.ChangeOf(0).IsPlain());
  // One value is better known, the other is another: whichever comes first.
  told.whole.model.shared << 0.0085, 0.00215;
  told.first.extension->uncertainty.parameters[1].std_error = 5e-4;
  EXPECT_TRUE(told.ChangeOf(0).IsPlain());
  told.first.naming.best.shared << 0.0, 0.008;
  told.whole.model.shared << 0.00215, 0.0085;
  std::swap(told.first.extension->uncertainty.parameters[0],
            told.first.extension->uncertainty.parameters[1]);
  EXPECT_TRUE(told.ChangeOf(0).IsPlain());
}

// A size whose error is not known neither is confirmed nor is another.
TEST(Unconfirmed, WhatIsNotKnownSaysNothing) {
  // The only other cause is not confirmed by it.
  Told told({"air_drag", "touchdown_loss"});
  told.whole.model.shared[1] = 0.4;
  ASSERT_EQ(Unconfirmed(told.first, told.whole).size(), 1u);
  told.first.extension->uncertainty.parameters[0].std_error.reset();
  EXPECT_FALSE(told.ChangeOf(0).is_known);
  EXPECT_TRUE(Unconfirmed(told.first, told.whole).empty());
  // Nor is it set aside itself.
  Told other({"air_drag", "touchdown_loss"});
  other.whole.model.shared[1] = 0.4;
  other.whole.uncertainty.parameters[1].std_error.reset();
  EXPECT_TRUE(Unconfirmed(other.first, other.whole).empty());
}

TEST(Unconfirmed, WhatIsAnotherSizeBesideACauseThatKeepsItsOwn) {
  Told told({"air_drag", "touchdown_loss"});
  EXPECT_TRUE(Unconfirmed(told.first, told.whole).empty());
  told.whole.model.shared[1] = 0.4;
  const std::vector<SetAside> out = Unconfirmed(told.first, told.whole);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].cause.Name(), "touchdown_loss");
  EXPECT_EQ(out[0].values[0], 1.0);
  ASSERT_TRUE(out[0].by_whole_trials);
  EXPECT_EQ((*out[0].by_whole_trials)[0], 0.4);
  EXPECT_DOUBLE_EQ(out[0].of_misfit, 0.8 * 0.25);
  // Something may do as well in its place: then that is to be told.
  told.first.naming.groups[1] = {1, 5};
  EXPECT_TRUE(Unconfirmed(told.first, told.whole).empty());
  told.first.naming.groups[1] = {1};
  // Beside nothing that is likely and keeps its size it stays.
  told.first.extension->causes[0].group_probability = 0.4;
  EXPECT_TRUE(Unconfirmed(told.first, told.whole).empty());
  told.first.extension->causes[0].group_probability = 0.97;
  told.whole.model.shared[0] = 0.4;
  EXPECT_TRUE(Unconfirmed(told.first, told.whole).empty());
}

const CauseReport& CauseCalled(const Diagnosis& d, const std::string& name) {
  const std::vector<CauseReport>& causes = d.extension.value().causes;
  const auto at = std::find_if(causes.begin(), causes.end(),
                               [&](const CauseReport& c) { return c.cause.Name() == name; });
  if (at == causes.end()) throw std::runtime_error(name + " is not told");
  return *at;
}

TEST(DiagnosedWithout, IsTheDiagnosisWithoutThatCause) {
  const Dataset hops = DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                              EffectOfSize("sensor_delay", 0.006)}});
  const DiagnosisOptions options = OptionsWith({"touchdown_angle_bias", "sensor_delay"});
  const Diagnosis with = Diagnose(hops, options);
  const CauseReport& delay = CauseCalled(with, "sensor_delay");
  const Diagnosis d =
      DiagnosedWithout(with, {AsSetAside(delay, *with.extension, with.naming)}, options);
  const CauseReport& bias = CauseCalled(d, "touchdown_angle_bias");
  EXPECT_EQ(d.extension->causes.size(), 1u);
  // As sure as it was with both.
  EXPECT_EQ(bias.group_probability, CauseCalled(with, "touchdown_angle_bias").group_probability);
  ASSERT_EQ(d.set_aside.size(), 1u);
  EXPECT_EQ(d.set_aside[0].cause.Name(), "sensor_delay");
  EXPECT_LT(d.extension->explained, with.extension->explained);
  EXPECT_EQ(d.naming.best_set, std::vector<int>{bias.candidate});
  EXPECT_EQ(d.naming.groups.front().front(), bias.candidate);
  EXPECT_EQ(d.naming.groups.size(), 1u);
  EXPECT_EQ(d.naming.gaps.size(), 1u);
  EXPECT_EQ(d.naming.without.size(), 1u);
  EXPECT_EQ(d.naming.candidates[static_cast<std::size_t>(delay.candidate)].status,
            CandidateStatus::kNotNeeded);
  // The model that never had it.
  const Diagnosis never = Diagnose(hops, OptionsWith({"touchdown_angle_bias"}));
  CauseCalled(never, "touchdown_angle_bias");
  for (int k = 0; k < never.naming.best.shared.size(); ++k)
    EXPECT_NEAR(d.naming.best.shared[k] / never.naming.best.shared[k], 1.0, 1e-3);
}

}  // namespace
}  // namespace hoplab
