// A robot's trials by their first stances, then as a whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fitting/diagnosis/diagnosis.h"
#include "fitting/followed_part.h"
#include "tests/support/robot_pronks.h"

namespace hoplab {
namespace {

// Half a second later the plain model's pronk goes another way, and no fit of the whole trials is
// a minimum.
TEST(Diagnose, NamesByTheFirstStancesWhatWholeTrialsHide) {
  const Dataset pronks = testing::RobotPronks(0.008, 0.8);
  DiagnosisOptions options;
  options.fit.jobs = 2;
  const DatasetFit whole =
      FitDataset(pronks, WithLegsAlike(options.problem), options.fit, Segmentation::kWhole);
  EXPECT_FALSE(whole.result.ok && whole.result.stop.IsMinimum());

  const Diagnosis d = Diagnose(pronks, options);
  ASSERT_EQ(d.refusal, "");
  ASSERT_TRUE(d.until);
  EXPECT_LT(*d.until, 0.8);
  EXPECT_EQ(d.verdict, Verdict::kNamed);
  ASSERT_TRUE(d.extension);
  ASSERT_EQ(d.extension->MainCauses().size(), 1u);
  EXPECT_EQ(d.extension->MainCauses().front()->cause.Name(), "com_offset");
  ASSERT_TRUE(d.carried_on);
  EXPECT_TRUE(d.carried_on->stop.IsMinimum())
      << (d.carried_on->stop.faults.empty() ? "" : d.carried_on->stop.faults.front());
  EXPECT_NEAR(d.carried_on->model.shared[0], 22e9, 0.01 * 22e9);
  EXPECT_NEAR(d.carried_on->model.ValuesOf(0)[0], 0.008, 0.0002);
  const ParameterUncertainty& E = d.carried_on->uncertainty.parameters.at(0);
  ASSERT_TRUE(E.ci95 && E.ci95_given_model);  // other models were asked
  EXPECT_LE(E.ci95->first, 22e9);
  EXPECT_GE(E.ci95->second, 22e9);
}

// Models so wrong that what their first rows lead to follows no more of them.
TEST(Diagnose, NamesWhatIsFarFromTheModel) {
  for (const std::string& far : {std::string("{hip_viscous_friction_1: {b_h: 0.4}}"),
                                 std::string("{motor_lag: {t_lag: 0.03}}")}) {
    DiagnosisOptions options;
    options.fit.jobs = 2;
    options.candidates.only = {"hip_viscous_friction_1", "motor_gain_1", "motor_lag",
                               "leg_stiffness_1"};
    const Diagnosis d = Diagnose(testing::RobotPronks(0.0, 0.6, far), options);
    ASSERT_EQ(d.refusal, "") << far;
    EXPECT_EQ(d.verdict, Verdict::kNamed) << far;
    ASSERT_TRUE(d.extension && d.extension->MainCauses().size() == 1u) << far;
    const std::string name = d.extension->MainCauses().front()->cause.Name();
    EXPECT_TRUE(far.starts_with("{" + name + ":")) << far << name;
  }
}

const std::string kThreeLate =
    "sensor_scale_x: {gain: 0.001725}, camera_roll: {roll: 0.00115}, constant_force: {force_x: "
    "0.023}";
const std::string kMostThree =
    "nothing is seen in the first stances, so no more than 3 causes together are told of the whole "
    "trials";

std::set<std::string> NamesOf(const Diagnosis& d) {
  std::set<std::string> names;
  if (!d.extension) return names;
  for (const CauseReport& c : d.extension->causes) names.insert(c.cause.Name());
  return names;
}

// Three small things that need time: nothing is seen in the first stances.
TEST(Diagnose, FindsThreeCausesThatShowLate) {
  DiagnosisOptions options;
  options.fit.jobs = 2;
  options.candidates.only = {"sensor_scale_x", "camera_roll", "constant_force", "motor_gain_1"};
  std::string stages;
  options.stage = [&](std::string_view stage) { stages += std::string(stage) + "\n"; };
  const Diagnosis d = Diagnose(testing::RobotPronks(0.0, 0.6, "{" + kThreeLate + "}"), options);
  EXPECT_NE(stages.find("up to there: adequate"), stages.npos) << stages;
  EXPECT_FALSE(d.until);
  EXPECT_EQ(NamesOf(d), std::set<std::string>({"sensor_scale_x", "camera_roll", "constant_force"}));
  EXPECT_NE(std::find(d.notes.begin(), d.notes.end(), kMostThree), d.notes.end());
}

// A fourth, which is as small, is told of whole trials that are asked for, and not late.
TEST(Diagnose, TellsNoFourthCauseThatShowsLate) {
  const Dataset pronks =
      testing::RobotPronks(0.0, 0.6, "{" + kThreeLate + ", motor_gain_1: {gamma: -0.0015}}");
  DiagnosisOptions options;
  options.fit.jobs = 2;
  options.candidates.only = {"sensor_scale_x", "camera_roll", "constant_force", "motor_gain_1"};
  const Diagnosis late = Diagnose(pronks, options);
  EXPECT_FALSE(late.until);
  EXPECT_LE(NamesOf(late).size(), 3u);
  EXPECT_NE(std::find(late.notes.begin(), late.notes.end(), kMostThree), late.notes.end());
  options.span = Segmentation::kWhole;
  EXPECT_EQ(NamesOf(Diagnose(pronks, options)).size(), 4u);
}

// A diagnosis of pronks whose mass sits `offset` ahead, stopped at the stage that begins so.
Diagnosis StoppedAt(const std::string& begin, double offset, std::vector<std::string> only) {
  std::atomic<bool> stop = false;
  DiagnosisOptions options;
  options.fit.jobs = 2;
  options.fit.stop = &stop;
  options.candidates.only = std::move(only);
  options.stage = [&](std::string_view stage) { stop = stop || stage.starts_with(begin); };
  Diagnosis d = Diagnose(testing::RobotPronks(offset, 0.8), options);
  EXPECT_TRUE(stop);
  return d;
}

// A name that was found stays where somebody waits for no more.
TEST(Diagnose, KeepsWhatWasNamedWhereTheWholeTrialsAreNotWaitedFor) {
  const Diagnosis d = StoppedAt("carrying on", 0.008, {"com_offset"});
  EXPECT_FALSE(d.interrupted);
  EXPECT_EQ(d.verdict, Verdict::kNamed);
  EXPECT_FALSE(d.carried_on);
  EXPECT_TRUE(d.cut_short);
  ASSERT_FALSE(d.notes.empty());
  EXPECT_EQ(d.notes.back(), "stopped: what the whole trials say was not looked at");
}

TEST(Diagnose, AnInterruptedStageIsNoVerdict) {
  const Diagnosis d = StoppedAt("looking for", 0.008, {});
  EXPECT_TRUE(d.interrupted);
  EXPECT_FALSE(d.carried_on);
}

TEST(Diagnose, KeepsTheVerdictOfTheFirstStancesWhereLongerPartsAreNotWaitedFor) {
  const Diagnosis d = StoppedAt("up to there", 0.008, {"sensor_scale_x"});
  EXPECT_FALSE(d.interrupted);
  EXPECT_TRUE(d.cut_short);
  EXPECT_EQ(d.verdict, Verdict::kUnexplained);
  ASSERT_FALSE(d.notes.empty());
  EXPECT_EQ(d.notes.back(), "stopped: what longer parts of the trials say was not looked at");
}

// That nothing is seen in the first stances is no verdict of the whole, but it is told.
TEST(Diagnose, TellsThatNothingIsSeenEarlyWhereTheWholeTrialsAreNotWaitedFor) {
  const Diagnosis d = StoppedAt("up to there: adequate", 0.0, {"com_offset"});
  EXPECT_TRUE(d.interrupted);
  ASSERT_FALSE(d.notes.empty());
  EXPECT_TRUE(d.notes.back().ends_with(" s of each trial show nothing that is missing"))
      << d.notes.back();
}

// The fit alone says how far it goes.
TEST(FitDataset, FitsAsMuchOfARobotsTrialsAsItFollows) {
  FitOptions options;
  options.jobs = 2;
  const Dataset pronks = testing::RobotPronks(0.008, 0.8);
  const FitProblem problem = MakeProblem(pronks, WithLegsAlike({}));
  const DatasetFit part = FitTraces(problem, options);
  ASSERT_TRUE(part.result.ok);
  EXPECT_TRUE(part.result.stop.IsMinimum());
  ASSERT_TRUE(part.until);
  EXPECT_GE(*part.until, *FirstStancesOver(problem));
  EXPECT_LT(*part.until, 0.8);
  EXPECT_LE(LongestTrial(part.problem.trials), *part.until);
  EXPECT_NE(part.note.find("only the first"), std::string::npos) << part.note;
}

}  // namespace
}  // namespace hoplab
