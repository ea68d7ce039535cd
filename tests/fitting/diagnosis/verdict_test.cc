#include "fitting/diagnosis/verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/diagnosed_hops.h"
#include "tests/support/input_error_of.h"

// The whole pipeline, from a dataset to its verdict.

namespace hoplab {
namespace {

using testing::DatasetOf;
using testing::EffectOfSize;
using testing::GroupNames;
using testing::OptionsWith;

TEST(Diagnose, CleanDataAreAdequatelySimulated) {
  const Diagnosis d = Diagnose(DatasetOf({}), OptionsWith(testing::kSixEffects));
  EXPECT_EQ(d.refusal, "");
  EXPECT_EQ(NameOf(d.verdict), "adequate") << d.reason;
  EXPECT_GT(d.detection.p_value, kDetectionLevel);
  EXPECT_FALSE(d.extension);
  EXPECT_FALSE(d.Cause());
  // Nothing is explained of what is left, which is of no consequence.
  EXPECT_EQ(d.left.share, 1.0);
  EXPECT_EQ(d.left.probability, d.naming.best.evidence.discrepancy_probability());
  EXPECT_FALSE(d.left.material);
}

TEST(Diagnose, CleanDataStillTellWhatTheyCouldHaveShown) {
  const Diagnosis d = Diagnose(DatasetOf({}), OptionsWith(testing::kSixEffects));
  ASSERT_EQ(d.naming.candidates.size(), testing::kSixEffects.size());
  for (const CandidateResult& c : d.naming.candidates) {
    EXPECT_EQ(c.status == CandidateStatus::kExcluded, c.power >= kTestable) << c.candidate.Name();
    EXPECT_TRUE(std::isfinite(c.bound95[0])) << c.candidate.Name();
  }
}

TEST(Diagnose, AClearEffectIsNamed) {
  const Diagnosis d = Diagnose(
      DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.05)}, .test = 2, .hops = 3}),
      OptionsWith(testing::kSixEffects));
  ASSERT_TRUE(d.extension);
  EXPECT_EQ(NameOf(d.verdict), "named") << d.reason << ", P " << d.extension->Probability();
  EXPECT_EQ(GroupNames(d.naming), std::vector<std::string>{"touchdown_angle_bias"});
  ASSERT_TRUE(d.Cause());
  EXPECT_EQ(d.naming.candidates[static_cast<std::size_t>(*d.Cause())].candidate.Name(),
            "touchdown_angle_bias");
  EXPECT_TRUE(d.extension->gain.IsClaim());
  EXPECT_GT(d.extension->explained, kExplained);
}

// One of three fifths of that size is as clear beside all others, and told with a P just below that
// of a sure name: `named` by the probabilities of before, which were of fewer cases.
TEST(Diagnose, ASmallerEffectIsNearlySure) {
  const Diagnosis d = Diagnose(
      DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}, .test = 2, .hops = 3}),
      OptionsWith(testing::kSixEffects));
  EXPECT_EQ(GroupNames(d.naming), std::vector<std::string>{"touchdown_angle_bias"});
  ASSERT_TRUE(d.extension);
  std::printf("  P %.3f\n", d.extension->Probability());
  EXPECT_GT(d.extension->Probability(), 0.94);
  EXPECT_TRUE(d.extension->gain.IsClaim());
  EXPECT_GT(d.extension->explained, kExplained);
}

TEST(Diagnose, TheExtensionBringsTheFittedValuesBackToTheTruth) {
  const Diagnosis d = Diagnose(DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}),
                               OptionsWith(testing::kSixEffects));
  ASSERT_TRUE(d.extension);
  const Movement& E = d.extension->movements.at(0);
  EXPECT_EQ(E.name, "E");
  EXPECT_LT(std::abs(E.after - 22e9), std::abs(E.before - 22e9));
  EXPECT_NEAR(E.after, 22e9, 0.02 * 22e9);
  // The standard error before holds what the simulation lacks, alike in all trials (decision 0016);
  // the move is still larger than an interval of 95 %, and larger by far than what is left.
  ASSERT_TRUE(E.std_errors);
  EXPECT_GT(std::abs(*E.std_errors), 2.0);
  EXPECT_LT(std::abs(E.after - 22e9), 0.25 * std::abs(E.after - E.before));
}

TEST(Diagnose, LookAlikesAreConfoundedAndATrialIsProposed) {
  // Between this little loss of speed at touch-down and another angle there the cosine is 0.93.
  const Diagnosis d =
      Diagnose(DatasetOf({.effects = {EffectOfSize("touchdown_loss", 0.02)}, .seed = 7}),
               OptionsWith({"touchdown_loss", "touchdown_angle_bias"}));
  EXPECT_EQ(NameOf(d.verdict), "confounded") << d.reason;
  const std::vector<std::string> group = GroupNames(d.naming);
  EXPECT_EQ(group.size(), 2u);
  EXPECT_NE(std::find(group.begin(), group.end(), "touchdown_loss"), group.end());
  ASSERT_TRUE(d.experiment);
  EXPECT_GT(d.experiment->expected_nats, 0.0);
}

// Whether one of the candidates is excluded, or has a bound.
bool Excludes(const Diagnosis& d) {
  return std::any_of(d.naming.candidates.begin(), d.naming.candidates.end(),
                     [](const CandidateResult& c) {
                       return c.status == CandidateStatus::kExcluded ||
                              (c.bound95.size() > 0 && std::isfinite(c.bound95[0]));
                     });
}

TEST(Diagnose, ExcludesCausesBesideANameThatIsSureAndBesideNoOther) {
  const Diagnosis named = Diagnose(
      DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.05)}, .test = 2, .hops = 3}),
      OptionsWith(testing::kSixEffects));
  ASSERT_EQ(named.verdict, Verdict::kNamed);
  EXPECT_TRUE(Excludes(named));
  const Diagnosis confounded =
      Diagnose(DatasetOf({.effects = {EffectOfSize("touchdown_loss", 0.02)}, .seed = 7}),
               OptionsWith({"touchdown_loss", "touchdown_angle_bias", "air_drag", "sensor_delay"}));
  ASSERT_EQ(confounded.verdict, Verdict::kConfounded);
  EXPECT_FALSE(Excludes(confounded));
  const Diagnosis unexplained =
      Diagnose(DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.05)}}),
               OptionsWith({"air_drag", "sensor_delay"}));
  ASSERT_EQ(unexplained.verdict, Verdict::kUnexplained);
  EXPECT_FALSE(Excludes(unexplained));
}

TEST(Diagnose, AnEffectThatNothingResemblesIsUnexplained) {
  const Diagnosis d = Diagnose(DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.05)}}),
                               OptionsWith({"air_drag", "sensor_delay"}));
  EXPECT_EQ(NameOf(d.verdict), "unexplained") << d.reason;
  ASSERT_TRUE(d.free_forces);
  EXPECT_LT(d.free_forces->forces.front().p_value, 1e-3);
}

TEST(Diagnose, AMisfitThatTheOnlyCandidateCannotExplainNamesNobody) {
  Dataset d = DatasetOf({});
  for (Trial& t : d.trials) {
    for (double& x : t.trace.columns[0].values) x *= 1.3;  // a scale that no sensor_delay makes
  }
  const Diagnosis result = Diagnose(d, OptionsWith({"sensor_delay"}));
  EXPECT_EQ(NameOf(result.verdict), "unexplained") << result.reason;
}

// Something is seen, of twice the noise or of this share of it; one main cause has this probability
// and explains this share, and it is certain that more is left but where all is explained.
Diagnosis Judged(double probability, double explained, double over_noise = 2.0) {
  Diagnosis d;
  d.detection.p_value = 0.0;
  d.detection.degrees_of_freedom = 1000;
  d.detection.chi2 = 1000.0 * (1.0 + over_noise * over_noise);
  d.naming.best.members = {testing::CandidateOf("air_drag")};
  d.naming.best.evidence.discrepancy = 100.0;
  d.naming.groups = {{0}};
  d.naming.best_set = {0};
  CauseReport cause;
  cause.candidate = 0;
  cause.cause = testing::CandidateOf("air_drag");
  cause.main = true;
  cause.probability = cause.group_probability = probability;
  ExtensionReport& e = d.extension.emplace();
  e.causes = {cause};
  e.explained = explained;
  e.remainder.p_value = explained < 1.0 ? 0.0 : 0.5;
  Judge(d, kMaterial);
  return d;
}
Verdict VerdictOf(double probability, double explained) {
  return Judged(probability, explained).verdict;
}

TEST(Verdict, GoesByTheProbabilityOfTheNameBeforeWhatItLeaves) {
  EXPECT_EQ(VerdictOf(0.97, 0.84), Verdict::kNamed);
  EXPECT_EQ(VerdictOf(0.94, 0.84), Verdict::kConfounded);
  EXPECT_EQ(VerdictOf(0.81, 0.4), Verdict::kConfounded);
  EXPECT_EQ(VerdictOf(0.79, 0.4), Verdict::kUnexplained);
  EXPECT_EQ(VerdictOf(0.79, 0.96), Verdict::kConfounded);
  EXPECT_EQ(VerdictOf(0.3, 0.96), Verdict::kUnexplained);
  EXPECT_EQ(VerdictOf(0.3, 1.0), Verdict::kConfounded);  // nothing is left to say otherwise
  EXPECT_EQ(VerdictOf(0.15, 1.0), Verdict::kUnexplained);
}

TEST(Verdict, AsksForMoreThanEvenOddsWhereMoreIsLeftThanTheNoise) {
  EXPECT_EQ(Judged(0.79, 0.96, 20.0).verdict, Verdict::kUnexplained);
  EXPECT_EQ(Judged(0.79, 0.96, 20.0).reason,
            "the best extension, air_drag, leaves more than the noise and is too unsure for that "
            "(probability 0.79)");
  EXPECT_EQ(Judged(0.3, 0.96, 20.0).reason,
            "the best extension, air_drag, is less likely than something outside the catalogue "
            "(probability 0.30)");
  EXPECT_EQ(Judged(0.81, 0.96, 20.0).verdict, Verdict::kConfounded);
  EXPECT_EQ(Judged(0.79, 0.999, 20.0).verdict, Verdict::kConfounded);  // 0.6 of the noise is left
}

// A model of another engine is never quite right: where no cause is likely, a misfit of a tenth of
// the noise asks for none.
TEST(Verdict, AMisfitFarBelowTheNoiseNamesNoUnlikelyCause) {
  const auto is_slight = [](const Diagnosis& d, double likely = kLikely) {
    return IsSlight(d.detection, *d.extension, likely);
  };
  for (double explained : {0.4, 1.0}) {
    EXPECT_TRUE(is_slight(Judged(0.3, explained, 0.1)));
    EXPECT_FALSE(is_slight(Judged(0.3, explained, 0.3)));
  }
  EXPECT_FALSE(is_slight(Judged(0.97, 1.0, 0.1)));  // small, and there
  EXPECT_FALSE(is_slight(Judged(0.7, 1.0, 0.1)));
  EXPECT_TRUE(is_slight(Judged(0.7, 1.0, 0.1), kProbable));  // seen late alone
  EXPECT_FALSE(is_slight(Judged(0.9, 1.0, 0.1), kProbable));
  // Noise that was stated too large is no reason to see less.
  Diagnosis quiet = Judged(0.3, 0.4);
  quiet.detection.chi2 = 900.0;
  EXPECT_FALSE(is_slight(quiet));
  // Another cause of the set is likely.
  Diagnosis two = Judged(0.3, 0.4, 0.1);
  EXPECT_TRUE(is_slight(two));
  two.extension->causes.push_back(two.extension->causes.front());
  two.extension->causes.back().group_probability = 0.97;
  EXPECT_FALSE(is_slight(two));
}

TEST(Verdict, WhereAllIsSetAsideTheModelIsAdequateAndNothingIsExcluded) {
  Diagnosis d = Judged(0.3, 0.4, 0.1);
  d.extension.reset();
  d.naming.best.evidence = {};
  d.naming.candidates.resize(1);
  d.naming.candidates[0].status = CandidateStatus::kExcluded;
  Judge(d, kMaterial);
  EXPECT_EQ(d.verdict, Verdict::kAdequate);
  EXPECT_EQ(d.naming.candidates[0].status, CandidateStatus::kExcluded);
  d.set_aside.resize(1);
  Judge(d, kMaterial);
  EXPECT_EQ(d.verdict, Verdict::kAdequate);
  EXPECT_NE(d.reason.find("0.10 of the noise"), std::string::npos) << d.reason;
  EXPECT_FALSE(d.ShowsLateAlone());
  d.set_aside.front().group_probability = 0.7;
  EXPECT_FALSE(d.ShowsLateAlone());  // no shorter part was looked at
  d.nothing_seen_before = true;
  EXPECT_TRUE(d.ShowsLateAlone());
  EXPECT_FALSE(NamesSomething(d));
  EXPECT_EQ(d.naming.candidates[0].status, CandidateStatus::kNotNeeded);
}

TEST(Verdict, AStandInCastsADoubtOnTheWholeAndOnNoName) {
  ExtensionReport e;
  for (const double probability : {0.97, 0.9, 0.3}) {
    CauseReport& c = e.causes.emplace_back();
    c.group_probability = probability;
    c.main = probability > 0.5;
    c.stands_in = !c.main;
  }
  EXPECT_DOUBLE_EQ(e.ToldProbability(), 0.9);
  EXPECT_DOUBLE_EQ(e.Probability(), 0.3);
}

// An angle off by a tenth of a degree, and no cause of that kind to choose from: many samples show
// it, it is far below the noise, and drag is most likely not what it is.
TEST(Diagnose, AMisfitFarBelowTheNoiseIsNotTold) {
  const Diagnosis d = Diagnose(DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.0014)},
                                          .train = 6,
                                          .test = 2,
                                          .rate_hz = 1000.0}),
                               OptionsWith({"air_drag"}));
  EXPECT_LE(d.detection.p_value, 1e-6);
  EXPECT_EQ(NameOf(d.verdict), "adequate") << d.reason;
  EXPECT_FALSE(d.extension);
  EXPECT_TRUE(d.naming.best.members.empty());
  ASSERT_EQ(d.set_aside.size(), 1u);
  EXPECT_EQ(d.set_aside[0].cause.Name(), "air_drag");
  EXPECT_DOUBLE_EQ(d.UnlistedProbability(), 1.0 - d.set_aside[0].group_probability);
  // Of the model as it is, and the interval holds the other.
  const ParameterUncertainty& E = d.uncertainty.parameters[0];
  const double with_drag = d.naming.candidates[0].alone.shared[0];
  ASSERT_TRUE(E.ci95 && E.ci95_given_model);
  EXPECT_LT(with_drag, d.null.shared[0]);
  EXPECT_LT(E.ci95->first, with_drag);
  EXPECT_LT(E.ci95->first, E.ci95_given_model->first);
}

TEST(Diagnose, StatedNoiseThatIsTooSmallRaisesNoAlarm) {
  Dataset d = DatasetOf({.rate_hz = 250.0});
  for (ChannelSpec& c : d.channels) c.sigma = 0.0004;
  const Diagnosis result = Diagnose(d, OptionsWith(testing::kSixEffects));
  EXPECT_EQ(NameOf(result.verdict), "adequate") << result.reason;
  EXPECT_TRUE(std::any_of(result.notes.begin(), result.notes.end(), [](const std::string& note) {
    return note.find("the flights scatter by") != std::string::npos;
  }));
}

// A leg softer than rubber stands only by a damping that no leg has.
TEST(Diagnose, NothingIsNamedWhereTheModelNeedsAValueThatCannotBe) {
  DiagnosisOptions options = OptionsWith({"gravity_scale", "sensor_delay"});
  options.problem.fix = {{"E", 1e7}};
  options.span = Segmentation::kWhole;
  const Diagnosis d = Diagnose(DatasetOf({.train = 1}), options);
  EXPECT_EQ(d.verdict, Verdict::kUnexplained) << d.reason;
  EXPECT_NE(d.reason.find("leaves d at the end of its range"), std::string::npos) << d.reason;
  ASSERT_TRUE(d.extension);
  for (const CauseReport& c : d.extension->causes) EXPECT_LE(c.group_probability, 0.49);
}

// With steps so coarse that derivatives are not to be trusted, finer ones are taken.
TEST(Diagnose, StepsAreFinerWhereDerivativesCannotBeTrusted) {
  DiagnosisOptions options = OptionsWith({"air_drag", "sensor_delay"});
  options.problem.integrator.relative_tolerance = 1e-3;
  options.problem.integrator.absolute_tolerance = 1e-4;
  options.span = Segmentation::kWhole;
  const Diagnosis d = Diagnose(DatasetOf({.effects = {EffectOfSize("air_drag", 0.05)}}), options);
  EXPECT_EQ(d.refusal, "");
  ASSERT_TRUE(d.extension);
  EXPECT_EQ(d.extension->ToldCauses().front()->cause.Name(), "air_drag");
  EXPECT_EQ(d.problem.integrator.relative_tolerance, kFinerSteps.relative_tolerance);
  EXPECT_LE(d.problem.integrator.absolute_tolerance, kFinerSteps.absolute_tolerance);
  EXPECT_TRUE(std::any_of(d.notes.begin(), d.notes.end(), [](const std::string& note) {
    return note.starts_with("simulated with finer steps");
  }));
}

TEST(Diagnose, ADatasetThatCannotBeFittedIsRefusedWithTheReason) {
  DiagnosisOptions options = OptionsWith(testing::kSixEffects);
  options.span = Segmentation::kWhole;
  Dataset dataset = DatasetOf({.train = 1});
  for (Trial& t : dataset.trials) t.mechanism.c_leg.rest_radius_m = 0.2;  // lands above its start
  const Diagnosis d = Diagnose(dataset, options);
  EXPECT_NE(
      d.refusal.find("no values found let every train trial be simulated to its end (train-1.csv"),
      std::string::npos)
      << d.refusal;
  EXPECT_TRUE(d.naming.candidates.empty());
}

TEST(Diagnose, AnUnknownEffectIsRefusedBeforeAnythingIsFitted) {
  const std::string error =
      testing::InputErrorOf([] { Diagnose(DatasetOf({.train = 1}), OptionsWith({"storm"})); });
  EXPECT_EQ(error.rfind("--effects", 0), 0u) << error;
}

TEST(Diagnose, StopsWhenAsked) {
  std::atomic<bool> stop{true};
  DiagnosisOptions options = OptionsWith(testing::kSixEffects);
  options.fit.stop = &stop;
  EXPECT_TRUE(Diagnose(DatasetOf({.train = 1}), options).interrupted);
}

TEST(Diagnose, TellsItsStagesInOrder) {
  std::vector<std::string> stages;
  DiagnosisOptions options = OptionsWith({"air_drag", "touchdown_angle_bias"});
  options.stage = [&](std::string_view s) { stages.emplace_back(s); };
  Diagnose(DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.03)}}), options);
  ASSERT_GE(stages.size(), 5u);
  EXPECT_EQ(stages.front(), "fitting the model as it is");
  EXPECT_NE(std::find(stages.begin(), stages.end(), "measuring on held-out trials"), stages.end());
}

}  // namespace
}  // namespace hoplab
