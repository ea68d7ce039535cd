#include "app/diagnosis_words.h"

#include <gtest/gtest.h>

#include <limits>

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
    d_.extension->after.test = {{1.2e-3, 1e-3}, 0.0, 100, 1, 0};
    d_.extension->gain.nats_per_sample = 2.0;
    d_.extension->gain.ci95 = {{1.0, 3.0}};
  }
  int Add(const char* effect, const char* only = "") {
    CandidateResult c;
    c.candidate = {FindEffect(effect), only};
    d_.naming.candidates.push_back(c);
    return static_cast<int>(d_.naming.candidates.size()) - 1;
  }
  void Accept(std::vector<int> group, const std::vector<double>& costs) {
    d_.naming.best.members.push_back(
        d_.naming.candidates[static_cast<std::size_t>(group.front())].candidate);
    std::vector<Extension> rivals;
    for (const double cost : costs) rivals.emplace_back().cost = cost;
    d_.naming.groups.push_back(std::move(group));
    d_.naming.rivals.push_back(std::move(rivals));
  }
  Diagnosis d_;
};

TEST_F(VerdictSentenceTest, NamesTheCauseAndWhatItTakesTheErrorTo) {
  Accept({Add("air_drag")}, {0.0});
  d_.verdict = Verdict::kNamed;
  const std::string text = VerdictSentence(d_);
  EXPECT_EQ(text.find("The simulation lacks air_drag (or something outside the catalogue"), 0u);
  EXPECT_NE(text.find("the test error of body_x from 8.85 to 1.20 mm"), std::string::npos) << text;
}

TEST_F(VerdictSentenceTest, DoubtsANameBesideWhichMisfitRemainsOrMayRemain) {
  Accept({Add("air_drag")}, {0.0});
  d_.verdict = Verdict::kNamed;
  d_.extension->explained = 0.997;
  d_.extension->remainder.p_value = 0.06;
  EXPECT_EQ(VerdictSentence(d_).find("The simulation lacks air_drag"), 0u);
  d_.extension->remainder.p_value = 0.03;
  EXPECT_NE(VerdictSentence(d_).find("something may remain (p = 0.030), so it may stand in for "
                                     "another cause"),
            std::string::npos)
      << VerdictSentence(d_);
  d_.extension->remainder.p_value = 0.002;
  EXPECT_EQ(VerdictSentence(d_).find("99.7 % of what the simulation misses is explained by "
                                     "air_drag"),
            0u);
  EXPECT_NE(VerdictSentence(d_).find("something remains, so"), std::string::npos);
}

TEST_F(VerdictSentenceTest, ClaimsNothingThatTheHeldOutTrialsDoNotShow) {
  Accept({Add("air_drag", "train-2.csv")}, {0.0});
  d_.verdict = Verdict::kNamed;
  d_.extension->gain.ci95 = {{-0.1, 3.0}};
  EXPECT_NE(VerdictSentence(d_).find("no gain is claimed"), std::string::npos);
  EXPECT_NE(VerdictSentence(d_).find("air_drag (in train-2.csv only)"), std::string::npos);
  d_.extension->gain.ci95.reset();
  EXPECT_NE(VerdictSentence(d_).find("too few to claim"), std::string::npos);
  d_.extension->after.test.trials = 0;
  EXPECT_NE(VerdictSentence(d_).find("no held-out trial"), std::string::npos);
}

TEST_F(VerdictSentenceTest, SaysWhatItCannotTellApart) {
  const int drag = Add("air_drag"), gravity = Add("gravity_scale"), loss = Add("touchdown_loss");
  Accept({drag, gravity}, {0.0, 0.4});
  d_.verdict = Verdict::kConfounded;
  EXPECT_EQ(VerdictSentence(d_).find("Cannot tell: air_drag and gravity_scale explain these hops "
                                     "equally well, within 0.4 nats"),
            0u);
  Accept({loss}, {0.0});
  EXPECT_NE(VerdictSentence(d_).find("lacks touchdown_loss; one of air_drag and gravity_scale"),
            std::string::npos)
      << VerdictSentence(d_);
}

TEST_F(VerdictSentenceTest, AnUnfinishedDiagnosisHasNone) {
  d_.refusal = "events: train-1.csv: fell";
  EXPECT_EQ(VerdictSentence(d_), "");
}

TEST_F(VerdictSentenceTest, AnUnexplainedMisfitGetsNoName) {
  Accept({Add("air_drag")}, {0.0});
  d_.verdict = Verdict::kUnexplained;
  d_.reason = "too little is explained";
  EXPECT_EQ(VerdictSentence(d_),
            "Something is missing, and nothing in the catalogue explains it: too little is "
            "explained.");
}

TEST(DiagnosisWords, NumbersAreNeverInvented) {
  EXPECT_EQ(ChanceText(std::numeric_limits<double>::quiet_NaN()), "p not computed");
  EXPECT_EQ(ChanceText(1e-9), "p < 0.001");
  EXPECT_EQ(ChanceText(0.31), "p = 0.31");
  EXPECT_EQ(SizeText(5e-4, "s"), "500 us");
  EXPECT_EQ(SizeText(0.012, "N s^2/m^2"), "0.012 N s^2/m^2");
  EXPECT_EQ(SizeText(0.05, "-"), "0.050");
}

}  // namespace
}  // namespace hoplab
