#include "fitting/diagnosis/localise.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::NullFit;

Linearisation Clean() {
  return NullFit(testing::World{}).With(testing::CandidatesOf({"air_drag", "touchdown_loss"}));
}

// Adds an offset to the residuals of rows that `in` picks; returns how many.
template <class In>
int Bump(Linearisation& at, const In& in) {
  int rows = 0;
  for (int row = 0; row < at.rows(); ++row) {
    if (at.labels[row].of != RowLabel::Of::kSample || !in(at.labels[row])) continue;
    at.r[row] += 5.0;
    ++rows;
  }
  return rows;
}

TEST(Localise, SharesSumToOne) {
  const Localisation l = Localise(Clean());
  double cells = 0.0, hops = 0.0, trials = 0.0;
  for (const MisfitCell& c : l.cells) cells += c.share;
  for (const MisfitPart& p : l.hops) hops += p.share;
  for (const MisfitPart& p : l.trials) trials += p.share;
  EXPECT_NEAR(cells, 1.0, 1e-12);
  EXPECT_NEAR(hops, 1.0, 1e-12);
  EXPECT_NEAR(trials, 1.0, 1e-12);
}

TEST(Localise, EverySampleIsInOneCellOneHopAndOneTrial) {
  const Linearisation at = Clean();
  const Localisation l = Localise(at);
  long cells = 0, hops = 0, trials = 0;
  double chi2 = 0.0, expected = 0.0;
  for (const MisfitCell& c : l.cells) {
    cells += c.rows;
    chi2 += c.chi2;
    expected += c.expected;
  }
  for (const MisfitPart& p : l.hops) hops += p.rows;
  for (const MisfitPart& p : l.trials) trials += p.rows;
  EXPECT_EQ(cells, at.samples);
  EXPECT_EQ(hops, at.samples);
  EXPECT_EQ(trials, at.samples);
  EXPECT_NEAR(chi2, l.chi2, 1e-9 * l.chi2);
  EXPECT_NEAR(expected, l.expected, 1e-9 * l.expected);
}

TEST(Localise, ExpectsWhatTheFitLeavesOfTheNoise) {
  const Linearisation at = Clean();
  double leverage = 0.0;
  for (int row = 0; row < at.rows(); ++row) {
    if (at.labels[row].of != RowLabel::Of::kPrior) leverage += at.leverage[row];
  }
  EXPECT_NEAR(Localise(at).expected, at.samples - leverage, 1e-9 * at.samples);
}

TEST(Localise, FindsABumpInItsCell) {
  Linearisation at = Clean();
  const auto in_cell = [](const RowLabel& l) {
    return l.mode == Mode::kFlight && l.channel == 1 && l.phase >= 1.0 / 3.0 && l.phase < 2.0 / 3.0;
  };
  const int rows = Bump(at, in_cell);
  ASSERT_GT(rows, 5);
  const MisfitCell worst = Localise(at).cells.front();
  EXPECT_EQ(worst.mode, Mode::kFlight);
  EXPECT_EQ(worst.phase, "middle");
  EXPECT_EQ(worst.channel, 1);
  EXPECT_EQ(worst.rows, rows);
  EXPECT_GT(worst.share, 0.9);
  EXPECT_LT(worst.p_value, 1e-10);
}

TEST(Localise, FindsTheTrialThatIsOff) {
  Linearisation at = Clean();
  Bump(at, [](const RowLabel& l) { return l.trial == 2; });
  for (const MisfitPart& p : Localise(at).trials) EXPECT_EQ(p.share > 0.9, p.index == 2) << p.index;
}

TEST(Localise, FindsTheHopThatIsOff) {
  Linearisation at = Clean();
  Bump(at, [](const RowLabel& l) { return l.hop == 1; });
  for (const MisfitPart& p : Localise(at).hops) EXPECT_EQ(p.share > 0.9, p.index == 1) << p.index;
}

TEST(Localise, CleanDataHaveNoCellThatStandsOut) {
  const Localisation l = Localise(Clean());
  for (const MisfitCell& c : l.cells) EXPECT_GT(c.p_value, 0.05 / 50.0) << c.phase << c.channel;
}

TEST(RunningEvidence, SumsToTheScore) {
  const NullFit fit(testing::World{.effects = {testing::EffectOfSize("air_drag", 0.05)}});
  const std::vector<Candidate> two = testing::CandidatesOf({"gravity_scale", "sensor_delay"});
  const Linearisation at = fit.With(two);
  const std::vector<Hypothesis> hypotheses = HypothesesOf(two);
  for (int k = 0; k < 2; ++k) {
    const double score = ScoreOf(at, hypotheses[k]).score;
    EXPECT_NEAR(RunningEvidence(at, k).sum(), score, 1e-9 * score) << k;
  }
}

TEST(RunningEvidence, ComesFromWhereTheEffectActs) {
  // Drag in train-2 alone: its rows carry the evidence for drag.
  const Dataset clean = testing::DatasetOf({});
  Dataset d = clean;
  d.trials[1] = testing::DatasetOf({.effects = {testing::EffectOfSize("air_drag", 0.2)}}).trials[1];
  const Linearisation at = NullFit(d).With({CandidateOf("air_drag")});
  const Eigen::VectorXd evidence = RunningEvidence(at, 0);
  std::array<double, 3> by_trial{};
  for (int row = 0; row < at.rows(); ++row) by_trial[at.labels[row].trial] += evidence[row];
  EXPECT_GT(by_trial[1], by_trial[0]);
  EXPECT_GT(by_trial[1], by_trial[2]);
}

TEST(RunningEvidence, OfNothingIsZero) {
  Linearisation at = Clean();
  at.columns.col(0).setZero();
  EXPECT_EQ(RunningEvidence(at, 0), Eigen::VectorXd::Zero(at.rows()));
}

}  // namespace
}  // namespace hoplab
