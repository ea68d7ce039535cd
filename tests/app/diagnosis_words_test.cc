#include "app/records/diagnosis_words.h"

#include <gtest/gtest.h>

#include <iterator>
#include <limits>
#include <sstream>

#include "tests/datasets/small_dataset.h"

namespace hoplab {
namespace {

// A diagnosis with a model extended by effects, and what does as well as each.
class VerdictSentenceTest : public ::testing::Test {
 protected:
  VerdictSentenceTest() {
    d_.problem = MakeProblem(testing::ReadWithYaml("{sigma: estimate}", "{sigma: 0.001}"), {});
    d_.detection.p_value = 1e-6;
    d_.before.test.rmse = {8.85e-3, 2e-3};
    d_.extension.emplace();
    d_.extension->explained = 1.0;
    d_.extension->after.test = {{1.2e-3, 1e-3}, 0.0, 100, 1, 0};
    d_.extension->gain.nats_per_sample = 2.0;
    d_.extension->gain.ci95 = {{1.0, 3.0}};
  }
  int Add(const char* effect, Recordings only = {}) {
    CandidateResult c;
    c.candidate = {FindEffect(effect), std::move(only)};
    d_.naming.candidates.push_back(c);
    return static_cast<int>(d_.naming.candidates.size()) - 1;
  }
  // A main cause with what does as well; `sure`: that one of them is right.
  void Accept(std::vector<int> group, double sure = 0.98, double share = 0.9) {
    const int first = group.front();
    const Candidate& c = d_.naming.candidates[static_cast<std::size_t>(first)].candidate;
    d_.naming.best.members.push_back(c);
    d_.naming.best_set.push_back(first);
    d_.naming.groups.push_back(std::move(group));
    CauseReport cause;
    cause.candidate = first;
    cause.cause = c;
    cause.group_probability = sure;
    cause.share = share;
    cause.main = true;
    d_.extension->causes.push_back(std::move(cause));
  }
  static long WordsOf(const std::string& text) {
    std::istringstream words(text);
    return std::distance(std::istream_iterator<std::string>(words), {});
  }
  Diagnosis d_;
};

TEST_F(VerdictSentenceTest, TellsAChannelThatIsLateOrLeftOut) {
  d_.extension.reset();
  d_.detection.p_value = 0.4;
  d_.verdict = Verdict::kAdequate;
  d_.odd_channel = OddChannel{Channel::kLegAngle};
  EXPECT_EQ(VerdictSentence(d_),
            "leg_angle disagrees with the other channels, in which nothing is missing (p = 0.40).");
  d_.odd_channel->offset_s = -8e-3;
  EXPECT_EQ(VerdictSentence(d_),
            "Nothing is missing but that leg_angle is 8.0 ms late (p = 0.40).");
  d_.odd_channel->offset_s = 8e-3;
  EXPECT_EQ(VerdictSentence(d_),
            "Nothing is missing but that leg_angle is 8.0 ms early (p = 0.40).");
}

TEST_F(VerdictSentenceTest, NamesTheCauseAndWhatItTakesTheErrorTo) {
  Accept({Add("air_drag")});
  d_.verdict = Verdict::kNamed;
  EXPECT_EQ(VerdictSentence(d_),
            "The simulation lacks air_drag; it takes the test error of body_x from 8.85 to 1.20 "
            "mm.");
}

TEST_F(VerdictSentenceTest, AMisfitOfOneChannelIsToldSo) {
  Accept({Add("air_drag")}, 0.3);
  d_.verdict = Verdict::kUnexplained;
  d_.localisation.cells = {{.channel = 1, .share = 0.6}, {.channel = 1, .share = 0.37}};
  EXPECT_NE(VerdictSentence(d_).find("does not hold, 97 % of it in body_y;"), std::string::npos)
      << VerdictSentence(d_);
  d_.localisation.cells[1].channel = 0;
  EXPECT_EQ(VerdictSentence(d_).find("of it in"), std::string::npos);
}

// Shares are of the misfit, where causes explain half of it, too.
TEST_F(VerdictSentenceTest, SharesAreOfTheMisfit) {
  Accept({Add("leg_material_damping")}, 0.99, 0.92);
  Accept({Add("touchdown_loss")}, 0.97, 0.0512);
  d_.verdict = Verdict::kNamed;
  d_.extension->explained = 0.5;
  const std::string text = VerdictSentence(d_);
  EXPECT_NE(text.find("leg_material_damping (46 %) and touchdown_loss (2.6 %)"), text.npos) << text;
}

TEST_F(VerdictSentenceTest, NamesMainCausesWithTheirSharesAndNoOthers) {
  Accept({Add("leg_material_damping")}, 0.99, 0.912);
  Accept({Add("touchdown_loss")}, 0.97, 0.0512);
  Accept({Add("sensor_offset_y")}, 0.97, 0.004);
  d_.extension->causes.back().main = false;
  d_.verdict = Verdict::kNamed;
  const std::string text = VerdictSentence(d_);
  EXPECT_EQ(text.find("The simulation lacks leg_material_damping (91 %) and touchdown_loss "
                      "(5.1 %); "),
            0u)
      << text;
  EXPECT_EQ(text.find("sensor_offset_y"), std::string::npos);
}

// Causes that do much the same explain little beside each other, and the misfit together.
TEST_F(VerdictSentenceTest, SaysWhatCausesExplainTogetherWhereEachAloneExplainsLittle) {
  Accept({Add("ground_compliance")}, 0.99, 0.093);
  Accept({Add("sensor_offset_y")}, 0.99, 0.080);
  d_.verdict = Verdict::kNamed;
  const std::string text = VerdictSentence(d_);
  EXPECT_EQ(text.find("The simulation lacks ground_compliance (9.3 %) and sensor_offset_y "
                      "(8.0 %), together 100 %; it takes"),
            0u)
      << text;
  EXPECT_LE(WordsOf(text), 30);
  // What an untold cause explains is not theirs.
  Accept({Add("leg_mass")}, 0.99, 0.7);
  d_.extension->causes.back().main = false;
  EXPECT_EQ(VerdictSentence(d_).find("together"), std::string::npos) << VerdictSentence(d_);
}

TEST_F(VerdictSentenceTest, SaysHowLikelyANameInDoubtIs) {
  Accept({Add("air_drag")}, 0.8);
  d_.verdict = Verdict::kConfounded;
  EXPECT_EQ(VerdictSentence(d_).find("The simulation probably lacks air_drag (P 0.80); "), 0u)
      << VerdictSentence(d_);
}

// What stands in for something not listed takes nothing from the cause that is told.
TEST_F(VerdictSentenceTest, SaysThatSomethingElseActsBesideALikelyCause) {
  Accept({Add("air_drag")}, 0.84);
  Accept({Add("touchdown_loss")}, 0.2, 0.03);
  d_.extension->causes.back().main = false;
  d_.extension->causes.back().stands_in = true;
  d_.verdict = Verdict::kConfounded;
  EXPECT_EQ(VerdictSentence(d_).find("The simulation probably lacks air_drag (P 0.84) and "
                                     "something not listed (P 0.80); "),
            0u)
      << VerdictSentence(d_);
  // Within thirty words, also where the misfit is slight.
  d_.detection.degrees_of_freedom = 10000;
  d_.detection.chi2 = 10144.0;
  EXPECT_LE(WordsOf(VerdictSentence(d_)), 30) << VerdictSentence(d_);
}

TEST_F(VerdictSentenceTest, NamesALikelyCauseBesideWhatIsNotListed) {
  Accept({Add("air_drag")}, 0.91, 0.83);
  Accept({Add("touchdown_loss")}, 0.07, 0.1);
  d_.extension->causes.back().main = false;
  d_.extension->causes.back().stands_in = true;
  d_.verdict = Verdict::kUnexplained;
  EXPECT_EQ(VerdictSentence(d_),
            "Something is missing that the catalogue does not hold; air_drag (P 0.91) explains "
            "83 % of the misfit.");
}

TEST_F(VerdictSentenceTest, NamesNoBestAttemptThatExplainsNothing) {
  Accept({Add("air_drag")}, 0.1);
  d_.verdict = Verdict::kUnexplained;
  d_.extension->explained = 0.004;
  EXPECT_EQ(VerdictSentence(d_),
            "Something is missing that the catalogue does not hold, and no cause in it explains "
            "any of the misfit.");
  d_.extension->explained = 0.006;
  EXPECT_NE(VerdictSentence(d_).find("the best attempt, air_drag, explains "), std::string::npos);
}

TEST_F(VerdictSentenceTest, SaysHowLittleIsMissedWhereANameIsInDoubt) {
  Accept({Add("air_drag")}, 0.8);
  d_.verdict = Verdict::kConfounded;
  d_.detection.degrees_of_freedom = 10000;
  d_.detection.chi2 = 10144.0;  // 0.12^2 more
  const std::string small = "The simulation is off by 0.12 of the noise and probably lacks ";
  EXPECT_EQ(VerdictSentence(d_).find(small + "air_drag (P 0.80); "), 0u) << VerdictSentence(d_);
  d_.detection.chi2 = 10500.0;
  EXPECT_EQ(VerdictSentence(d_).find("The simulation probably lacks "), 0u) << VerdictSentence(d_);
  d_.detection.chi2 = 9900.0;  // noise that was stated too large
  EXPECT_EQ(VerdictSentence(d_).find("The simulation probably lacks "), 0u) << VerdictSentence(d_);
}

TEST_F(VerdictSentenceTest, ClaimsNothingThatTheHeldOutTrialsDoNotShow) {
  Accept({Add("air_drag")});
  d_.verdict = Verdict::kNamed;
  d_.extension->gain.ci95 = {{-0.1, 3.0}};
  EXPECT_NE(VerdictSentence(d_).find("held-out trials do not confirm it"), std::string::npos);
  d_.extension->gain.ci95.reset();
  EXPECT_NE(VerdictSentence(d_).find("too little is held out to claim a gain"), std::string::npos);
  d_.extension->after.test.trials = 0;
  EXPECT_NE(VerdictSentence(d_).find("no held-out trial confirms it"), std::string::npos);
}

TEST_F(VerdictSentenceTest, SaysThatNoHeldOutTrialCanConfirmWhatActsInOthersAlone) {
  Accept({Add("air_drag", {"train-2.csv", "train-4.csv"})});
  d_.verdict = Verdict::kNamed;
  d_.extension->gain.ci95 = {{-0.1, 3.0}};
  EXPECT_EQ(VerdictSentence(d_),
            "The simulation lacks air_drag in train-2.csv and train-4.csv; held-out trials cannot "
            "confirm what acts in those alone.");
  d_.extension->gain.ci95 = {{-3.0, -1.0}};
  EXPECT_NE(VerdictSentence(d_).find("held-out trials are missed by more: some may have it, too"),
            std::string::npos);
  d_.extension->causes[0].cause.only_recordings = {"train-2.csv"};
  EXPECT_NE(VerdictSentence(d_).find("air_drag in train-2.csv; held-out"), std::string::npos);
  d_.extension->causes[0].cause.only_recordings = {"a", "b", "c", "d"};
  EXPECT_NE(VerdictSentence(d_).find("air_drag in 4 trials"), std::string::npos)
      << VerdictSentence(d_);
}

TEST_F(VerdictSentenceTest, SaysWhatItCannotTellApart) {
  const int drag = Add("air_drag"), gravity = Add("gravity_scale"), loss = Add("touchdown_loss");
  Accept({drag, gravity});
  d_.verdict = Verdict::kConfounded;
  EXPECT_EQ(VerdictSentence(d_).find("The simulation lacks air_drag or gravity_scale; "), 0u)
      << VerdictSentence(d_);
  Accept({loss}, 0.98, 0.05);
  EXPECT_NE(VerdictSentence(d_).find("air_drag or gravity_scale (90 %) and touchdown_loss (5.0 %)"),
            std::string::npos)
      << VerdictSentence(d_);
}

TEST_F(VerdictSentenceTest, HasAtMostThirtyWordsHoweverManyNamesThereAre) {
  std::vector<int> many;
  for (const char* name : {"air_drag", "gravity_scale", "clock_scale", "camera_roll"})
    many.push_back(Add(name, {"train-2.csv"}));
  Accept(many, 0.7, 0.5);
  for (const char* name : {"touchdown_loss", "leg_hardening", "foot_slip"})
    Accept({Add(name, {"train-3.csv"})}, 0.7, 0.1);
  for (const Verdict v :
       {Verdict::kNamed, Verdict::kConfounded, Verdict::kUnexplained, Verdict::kAdequate}) {
    d_.verdict = v;
    EXPECT_LE(WordsOf(VerdictSentence(d_)), 30) << VerdictSentence(d_);
  }
}

TEST_F(VerdictSentenceTest, AnUnfinishedDiagnosisHasNone) {
  d_.refusal = "events: train-1.csv: fell";
  EXPECT_EQ(VerdictSentence(d_), "");
}

TEST_F(VerdictSentenceTest, AnUnexplainedMisfitIsToldWithTheBestAttempt) {
  Accept({Add("air_drag")});
  d_.extension->explained = 0.6;
  d_.verdict = Verdict::kUnexplained;
  EXPECT_EQ(VerdictSentence(d_),
            "Something is missing that the catalogue does not hold; the best attempt, air_drag, "
            "explains 60 % of the misfit.");
  d_.extension->at_bound = true;
  EXPECT_NE(VerdictSentence(d_).find("needs a size beyond what is physical"), std::string::npos);
  d_.extension->at_bound = false;
  d_.extension->at_wall = {"d"};
  EXPECT_NE(VerdictSentence(d_).find("air_drag, leaves d at the end of its range."),
            std::string::npos);
}

// Noise is what is left beside the smooth error, and not all that is left.
TEST_F(VerdictSentenceTest, TheRemainderTellsOfASmoothErrorAboveTheNoise) {
  d_.naming.best.problem = d_.problem;
  d_.extension->remainder.p_value = 0.12;
  EXPECT_EQ(RemainderSentence(d_), "what is left looks like noise (p = 0.12)");
  std::vector<double>& amplitude = d_.naming.best.problem.noise.amplitude;
  amplitude.assign(d_.problem.channels.size(), 0.0);
  amplitude[0] = 0.4;
  d_.naming.best.problem.noise.time_scale = 0.262;
  d_.extension->explained = 0.9951;
  EXPECT_EQ(RemainderSentence(d_),
            "beside a smooth error of body_x 0.400 mm over 262 ms the rest looks like noise (p = "
            "0.12)");
  amplitude[0] = 2.51;
  EXPECT_EQ(RemainderSentence(d_),
            "99.5 % of the misfit is explained, not all of it: beside a smooth error of body_x "
            "2.51 mm over 262 ms the rest looks like noise (p = 0.12)");
  amplitude[0] = 0.4;
  d_.extension->explained = 0.907;
  d_.extension->remainder.p_value = 0.03;
  EXPECT_EQ(RemainderSentence(d_),
            "90.7 % of the misfit is explained, not all of it: beside a smooth error of body_x "
            "0.400 mm over 262 ms the rest may be noise or not (p = 0.030)");
}

TEST(DiagnosisWords, SharesAreNeverRoundedUp) {
  EXPECT_EQ(ShareText(0.9999), "99 %");
  EXPECT_EQ(ShareText(1.0), "100 %");
  EXPECT_EQ(ShareText(0.0512), "5.1 %");
  EXPECT_EQ(ShareText(0.0004), "under 0.1 %");
  EXPECT_EQ(ShareText(-0.1), "0.0 %");
}

TEST(DiagnosisWords, NumbersAreNeverInvented) {
  EXPECT_EQ(ChanceText(std::numeric_limits<double>::quiet_NaN()), "p not computed");
  EXPECT_EQ(ChanceText(1e-9), "p < 0.001");
  EXPECT_EQ(ChanceText(0.31), "p = 0.31");
  EXPECT_EQ(SizeText(5e-4, "s"), "500 us");
  EXPECT_EQ(SizeText(0.012, "N s^2/m^2"), "0.012 N s^2/m^2");
  EXPECT_EQ(SizeText(0.05, "-"), "0.050");
}

// A value that the data say nothing about is not told as one, nor one at a bound as an estimate.
TEST(ValuesText, SaysWhatIsNotDetermined) {
  const FitProblem problem =
      MakeProblem(testing::ReadWithYaml("{sigma: estimate}", "{sigma: 0.001}"), {});
  ASSERT_GE(problem.shared_count(), 2);
  Eigen::VectorXd shared = InitialShared(problem);
  shared[0] = 22e9;
  Uncertainty uncertainty;
  uncertainty.parameters.resize(static_cast<std::size_t>(problem.shared_count()));
  uncertainty.parameters[0].ci95 = {{21e9, 23e9}};
  const std::string told = ValuesText(problem, shared, uncertainty);
  EXPECT_NE(told.find("E 22.00 (21.00 .. 23.00) GPa"), std::string::npos) << told;
  EXPECT_NE(told.find(problem.shared[1].name + " not determined"), std::string::npos) << told;
  uncertainty.parameters[0].ci95.reset();
  uncertainty.parameters[0].at_bound = true;
  const std::string at_end = ValuesText(problem, shared, uncertainty);
  EXPECT_NE(at_end.find("E 22.00 GPa (the end of its range)"), std::string::npos) << at_end;
}

}  // namespace
}  // namespace hoplab
