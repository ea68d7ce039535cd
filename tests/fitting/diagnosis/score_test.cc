#include "fitting/diagnosis/score.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::CandidateOf;
using testing::NullFit;

constexpr double kInf = std::numeric_limits<double>::infinity();

Eigen::VectorXd Noise(int rows, std::uint64_t stream) {
  RandomStream random(17, stream);
  Eigen::VectorXd v(rows);
  for (double& x : v) x = random.Normal();
  return v;
}

// A linearisation with nothing fitted: random columns, white noise as residuals.
Linearisation Synthetic(int rows, int columns, std::uint64_t noise_stream = 0) {
  Linearisation at;
  at.r = at.raw = Noise(rows, noise_stream);
  at.columns.resize(rows, columns);
  for (int k = 0; k < columns; ++k) at.columns.col(k) = Noise(rows, 1000 + k);
  at.length = at.columns.colwise().norm().transpose();
  at.fitted_basis.resize(rows, 0);
  at.along_fitted.resize(0, at.columns.cols());
  return at;
}

Hypothesis Column(int k, double lower = -kInf, double upper = kInf) {
  return {k, 1, Eigen::VectorXd::Constant(1, lower), Eigen::VectorXd::Constant(1, upper)};
}
Hypothesis Columns(int first, int count) {
  return {first, count, Eigen::VectorXd::Constant(count, -kInf),
          Eigen::VectorXd::Constant(count, kInf)};
}

// Chi-square of r after least squares on the columns of X, which are scaled first.
double LeastSquares(Eigen::MatrixXd X, const Eigen::VectorXd& r, Eigen::VectorXd* b = nullptr) {
  const Eigen::VectorXd scale = X.colwise().norm().transpose();
  X *= scale.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(X, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd solution = svd.solve(r);
  if (b) *b = solution.cwiseQuotient(scale);
  return (r - X * solution).squaredNorm();
}

TEST(Score, IsTheGainOfTheLinearModel) {
  // One trial: fitted values, its start and the candidate in one dense least-squares problem.
  const NullFit fit(
      testing::World{.effects = {testing::EffectOfSize("gravity_scale", 0.02)}, .train = 1});
  const std::vector<Candidate> tested = {CandidateOf("gravity_scale"), CandidateOf("sensor_delay")};
  const Linearisation at = fit.With(tested);
  const FitProblem extended = Extend(fit.problem, tested);
  Eigen::VectorXd shared(4);
  shared << fit.null.shared, NullValues(tested);
  TrialEvaluation e;
  TrialEvaluator(extended, fit.train[0]).Evaluate({shared, fit.null.initial_states[0], true}, e);
  Eigen::MatrixXd S(e.residuals.size(), 6);
  S << e.jacobian.leftCols(2), e.jacobian.rightCols(4);
  const double without = LeastSquares(S, e.residuals);
  for (int k = 0; k < 2; ++k) {
    Eigen::MatrixXd with(S.rows(), 7);
    with << S, e.jacobian.col(2 + k);
    Eigen::VectorXd b;
    const double chi2 = LeastSquares(with, e.residuals, &b);
    const Score score = ScoreOf(at, Column(k));
    EXPECT_NEAR(score.score, without - chi2, 1e-7 * without) << k;
    EXPECT_NEAR(score.size[0], -b[6], 1e-6 * std::abs(b[6])) << k;
    EXPECT_EQ(score.predicted_gain, 0.5 * score.score);
    EXPECT_EQ(score.rank, 1);
  }
}

TEST(Score, OfSeveralColumnsIsTheGainOfAllTogether) {
  const Linearisation at = Synthetic(50, 3);
  Eigen::VectorXd b;
  const double chi2 = LeastSquares(at.columns, at.r, &b);
  const Score score = ScoreOf(at, Columns(0, 3));
  EXPECT_NEAR(score.score, at.r.squaredNorm() - chi2, 1e-10);
  EXPECT_LT((score.size + b).norm(), 1e-10);
  EXPECT_EQ(score.rank, 3);
}

TEST(Score, DoesNotDependOnTheUnitsOfAColumn) {
  Linearisation at = Synthetic(50, 2);
  const Score before = ScoreOf(at, Columns(0, 2));
  at.columns.col(1) *= 1e9;
  at.length[1] *= 1e9;
  const Score after = ScoreOf(at, Columns(0, 2));
  EXPECT_NEAR(after.score, before.score, 1e-10 * before.score);
  EXPECT_NEAR(after.size[1] * 1e9, before.size[1], 1e-10 * std::abs(before.size[1]));
}

TEST(Score, OnTheWrongSideOfABoundIsZero) {
  Linearisation at = Synthetic(50, 1);
  at.r = 0.5 * at.columns.col(0);  // simulated - measured: the best size is -0.5
  EXPECT_GT(ScoreOf(at, Column(0)).score, 0.0);
  EXPECT_NEAR(ScoreOf(at, Column(0)).size[0], -0.5, 1e-12);
  EXPECT_EQ(ScoreOf(at, Column(0, 0.0, kInf)).score, 0.0);
  EXPECT_GT(ScoreOf(at, Column(0, 0.0, kInf)).p_value, 0.5);
  EXPECT_GT(ScoreOf(at, Column(0, -kInf, 0.0)).score, 0.0);
}

TEST(Score, OnOneSideHasHalfTheTail) {
  const Linearisation at = Synthetic(50, 1);
  const double two_sided = ScoreOf(at, Column(0)).p_value;
  const double size = ScoreOf(at, Column(0)).size[0];
  const Hypothesis right = size > 0 ? Column(0, 0.0, kInf) : Column(0, -kInf, 0.0);
  EXPECT_NEAR(ScoreOf(at, right).p_value, 0.5 * two_sided, 1e-12);
}

TEST(Score, OfTwoCollinearColumnsHasRankOne) {
  Linearisation at = Synthetic(50, 2);
  at.columns.col(1) = -3.0 * at.columns.col(0);
  at.length[1] = 3.0 * at.length[0];
  const Score both = ScoreOf(at, Columns(0, 2));
  EXPECT_EQ(both.rank, 1);
  EXPECT_NEAR(both.score, ScoreOf(at, Column(0)).score, 1e-10);
  EXPECT_NEAR(both.p_value, ScoreOf(at, Column(0)).p_value, 1e-10);
}

// Rounding tells two columns apart that are one, by sizes without end.
TEST(Score, SizesOfColumnsThatCannotBeToldApartAreNotRounding) {
  Linearisation at = Synthetic(50, 2);
  const Eigen::VectorXd rounding = 1e-12 * Noise(50, 7);
  at.columns.col(1) = -3.0 * at.columns.col(0) + rounding;
  at.length[1] = 3.0 * at.length[0];
  const double alone = ScoreOf(at, Column(0)).size[0];
  const Score both = ScoreOf(at, Columns(0, 2));
  EXPECT_EQ(both.rank, 1);
  EXPECT_NEAR(both.size[0], alone / 2.0, 1e-9 * std::abs(alone));
  EXPECT_NEAR(both.size[1], -alone / 6.0, 1e-9 * std::abs(alone));
}

// Beside one that can be told, what the fitted values explain has no size either.
TEST(Score, OfColumnsThatAreExplainedInPartHasSizesOfTheOthers) {
  Linearisation at = Synthetic(50, 2);
  at.length[1] = 1e6 * at.columns.col(1).norm();
  const Score both = ScoreOf(at, Columns(0, 2));
  EXPECT_EQ(both.rank, 1);
  EXPECT_NEAR(both.size[0], ScoreOf(at, Column(0)).size[0], 1e-12);
  EXPECT_TRUE(std::isnan(both.size[1]));
}

TEST(Score, OfAColumnTheFittedValuesExplainIsNone) {
  Linearisation at = Synthetic(50, 1);
  at.length[0] = 1e6 * at.columns.col(0).norm();  // all but rounding was projected out
  EXPECT_EQ(Information(at, 0), 0.0);
  const Score score = ScoreOf(at, Column(0));
  EXPECT_EQ(score.rank, 0);
  EXPECT_EQ(score.p_value, 1.0);
  EXPECT_TRUE(std::isnan(score.size[0]));
  EXPECT_EQ(DetectableSize(at, 0, 3.84), kInf);
}

TEST(DetectableSize, IsFoundFourTimesOutOfFive) {
  const Linearisation at = Synthetic(50, 1);
  const double threshold = 3.841458820694124;
  const double shift = DetectableSize(at, 0, threshold) * std::sqrt(Information(at, 0));
  const double cut = std::sqrt(threshold);
  // Both tails of a normal about `shift`; the far one adds a part in a million.
  const double power = 0.5 * std::erfc((cut - shift) / std::sqrt(2.0)) +
                       0.5 * std::erfc((cut + shift) / std::sqrt(2.0));
  EXPECT_NEAR(power, 0.8, 1e-5);
}

TEST(Hypotheses, LeaveEachParameterItsRoomOnEitherSideOfNull) {
  const std::vector<Candidate> two = {CandidateOf("gravity_scale"), CandidateOf("air_drag")};
  const std::vector<Hypothesis> h = HypothesesOf(two);
  ASSERT_EQ(h.size(), 2u);
  EXPECT_EQ(h[1].first, 1);
  EXPECT_LT(h[0].lower[0], 0.0);
  EXPECT_GT(h[0].upper[0], 0.0);
  EXPECT_EQ(h[1].lower[0], 0.0);
}

TEST(ScoreTests, GlobalPIsUniformUnderWhiteNoise) {
  // Single columns, one-sided ones, look-alikes and a group of three, as a diagnosis has.
  std::vector<Hypothesis> hypotheses = {Column(0), Column(1), Column(2, 0.0, kInf),
                                        Column(3, 0.0, kInf), Columns(4, 3)};
  constexpr int kDraws = 200;
  std::vector<double> p;
  for (int draw = 0; draw < kDraws; ++draw) {
    Linearisation at = Synthetic(40, 7, 2000 + draw);
    at.columns.col(1) = at.columns.col(0) + 0.1 * at.columns.col(1);
    at.length[1] = at.columns.col(1).norm();
    p.push_back(TestScores(at, hypotheses, 1).global_p);
  }
  std::sort(p.begin(), p.end());
  double distance = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    distance = std::max({distance, (i + 1.0) / kDraws - p[i], p[i] - i / double(kDraws)});
  }
  EXPECT_LT(distance, 1.63 / std::sqrt(double(kDraws)));  // Kolmogorov-Smirnov, 1 %
}

TEST(ScoreTests, ManyHypothesesMakeOneExtremeScoreLessTelling) {
  Linearisation at = Synthetic(100, 20);
  at.r += 3.0 * at.columns.col(4).normalized();
  std::vector<Hypothesis> all;
  for (int k = 0; k < 20; ++k) all.push_back(Column(k));
  const double one = TestScores(at, std::vector{Column(4)}, 1).global_p;
  const double many = TestScores(at, all, 1).global_p;
  EXPECT_GT(many, 2.0 * one);
}

TEST(ScoreTests, BeyondAllDrawsTheBoundOfTheSmallestPHolds) {
  Linearisation at = Synthetic(100, 3);
  at.r += 12.0 * at.columns.col(0).normalized();
  const std::vector<Hypothesis> all = {Column(0), Column(1), Column(2)};
  const ScoreTests tests = TestScores(at, all, 1);
  EXPECT_LT(tests.global_p, 1e-10);
  EXPECT_NEAR(tests.global_p, 3.0 * tests.smallest_p, 1e-12 * tests.smallest_p);
}

TEST(ScoreTests, WithoutAnythingToTestFindNothing) {
  Linearisation at = Synthetic(20, 1);
  at.columns.setZero();
  EXPECT_EQ(TestScores(at, std::vector{Column(0)}, 1).global_p, 1.0);
  EXPECT_EQ(TestScores(at, std::vector<Hypothesis>{}, 1).global_p, 1.0);
}

TEST(ScoreTests, RepeatWithTheSameSeed) {
  const Linearisation at = Synthetic(40, 4);
  const std::vector<Hypothesis> all = {Column(0), Columns(1, 3)};
  EXPECT_EQ(TestScores(at, all, 7).global_p, TestScores(at, all, 7).global_p);
}

}  // namespace
}  // namespace hoplab
