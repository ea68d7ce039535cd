#include "fitting/discrepancy/estimate_discrepancy.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "fitting/solve.h"
#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

// Generated hops with a Matern 3/2 process of known size added to what was measured.
struct Disturbed {
  FitProblem problem;
  std::vector<TrialProblem> trials;
  Eigen::VectorXd shared;
  std::vector<OwnValues> initial_states;

  Disturbed(std::vector<double> ratios, double scale, std::uint64_t seed, int train = 2)
      : problem(MakeProblem(testing::SmallDataset(train, 1, seed, 200.0), {})) {
    const std::size_t width = problem.channels.size();
    for (std::size_t i = 0; i < problem.trials.size(); ++i) {
      TrialProblem& t = problem.trials[i];
      for (std::size_t c = 0; c < width; ++c) {
        RandomStream random(seed, 100 * i + c + 1);
        const auto n = static_cast<Eigen::Index>(t.row_times.size());
        Eigen::MatrixXd C(n, n);
        Eigen::VectorXd white(n);
        for (Eigen::Index a = 0; a < n; ++a) {
          white[a] = random.Normal();
          for (Eigen::Index b = 0; b < n; ++b) {
            const double x = std::sqrt(3.0) * std::abs(t.row_times[a] - t.row_times[b]) / scale;
            C(a, b) = (1.0 + x) * std::exp(-x) + (a == b ? 1e-10 : 0.0);
          }
        }
        const Eigen::VectorXd delta = C.llt().matrixL() * white;
        for (Eigen::Index a = 0; a < n; ++a)
          t.data[static_cast<std::size_t>(a) * width + c] +=
              ratios[c] * problem.channels[c].sigma * delta[a];
      }
    }
    trials = TrialsOf(problem, TrialRole::kTrain);
    SolveRequest request;
    request.problem = &problem;
    request.trials = &trials;
    request.shared = Eigen::Vector2d(22e9, 3.0);
    request.initial_states = testing::NominalInitialStates(trials);
    const SolveResult r = Solve(request);
    shared = r.shared;
    initial_states = r.initial_states;
  }
  RestrictedLikelihood Likelihood() const { return {problem, trials, shared, initial_states, 1}; }
};

// The definition, by dense matrices: every row, every free column, flat priors.
double Dense(const Disturbed& d, const NoiseModel& noise) {
  double value = 0.0;
  Eigen::Index rows = 0;
  const int n = d.problem.shared_count();
  std::vector<Eigen::MatrixXd> J;
  std::vector<Eigen::VectorXd> r;
  for (std::size_t i = 0; i < d.trials.size(); ++i) {
    TrialEvaluation e;
    EvaluationRequest q{d.shared, d.initial_states[i], true};
    q.whiten = false;
    TrialEvaluator(d.problem, d.trials[i]).Evaluate(q, e);
    Eigen::MatrixXd C = Eigen::MatrixXd::Identity(e.residuals.size(), e.residuals.size());
    const std::size_t width = d.problem.channels.size();
    for (int a = 0; a < e.data_residuals; ++a) {
      for (int b = 0; b < e.data_residuals; ++b) {
        const std::size_t c = static_cast<std::size_t>(a) % width;
        if (static_cast<std::size_t>(b) % width != c) continue;
        const double x = std::sqrt(3.0) / noise.time_scale *
                         std::abs(d.trials[i].row_times[static_cast<std::size_t>(a) / width] -
                                  d.trials[i].row_times[static_cast<std::size_t>(b) / width]);
        C(a, b) += std::pow(noise.AmplitudeOf(c), 2) * (1.0 + x) * std::exp(-x);
      }
    }
    const Eigen::LLT<Eigen::MatrixXd> llt(C);
    const Eigen::MatrixXd L = llt.matrixL();
    value -= L.diagonal().array().log().sum();
    Eigen::MatrixXd scaled = e.jacobian;
    for (int k = 0; k < n; ++k) scaled.col(k) *= d.problem.shared[k].scale;
    for (int k = 0; k < d.trials[i].own_count(); ++k) scaled.col(n + k) *= d.trials[i].own[k].scale;
    J.push_back(llt.matrixL().solve(scaled));
    r.push_back(llt.matrixL().solve(e.residuals));
    rows += r.back().size();
  }
  const Eigen::Index own = 4;
  Eigen::MatrixXd all =
      Eigen::MatrixXd::Zero(rows, n + own * static_cast<Eigen::Index>(d.trials.size()));
  Eigen::VectorXd residuals(rows);
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < J.size(); ++i) {
    all.block(at, 0, J[i].rows(), n) = J[i].leftCols(n);
    all.block(at, n + own * static_cast<Eigen::Index>(i), J[i].rows(), own) = J[i].rightCols(own);
    residuals.segment(at, J[i].rows()) = r[i];
    at += J[i].rows();
  }
  const Eigen::MatrixXd H = all.transpose() * all;
  const Eigen::VectorXd step = all.householderQr().solve(residuals);
  const Eigen::MatrixXd L = H.llt().matrixL();
  return value - 0.5 * (residuals - all * step).squaredNorm() - L.diagonal().array().log().sum();
}

TEST(RestrictedLikelihood, IsTheOneOfDenseMatrices) {
  const Disturbed d({2.0, 1.0}, 0.05, 3);
  const RestrictedLikelihood likelihood = d.Likelihood();
  const NoiseModel first{{2.0, 1.0}, 0.05}, second{{0.3, 4.0}, 0.2};
  const double fast = likelihood.At(first) - likelihood.At(second);
  const double dense = Dense(d, first) - Dense(d, second);
  EXPECT_NEAR(fast, dense, 1e-6 * std::abs(dense) + 1e-6);
  EXPECT_NEAR(likelihood.At(first), Dense(d, first), 1e-6 * std::abs(dense) + 1e-6);
}

TEST(RestrictedLikelihood, InAnotherDetailIsTheOneSimulatedInIt) {
  const Disturbed d({0.5, 0.5}, 0.02, 3, 4);
  LikelihoodDetail detail = LikelihoodDetail::Coarse();
  detail.rows_a_channel = 20;
  detail.most_samples = 300;  // every second trial or fewer
  const RestrictedLikelihood made(d.problem, d.trials, d.shared, d.initial_states, 1, detail);
  const RestrictedLikelihood taken = d.Likelihood().With(detail);
  const NoiseModel noise{{0.5, 0.7}, 0.02};
  ASSERT_NE(made.At(noise), d.Likelihood().At(noise));
  EXPECT_EQ(taken.At(noise), made.At(noise));
  EXPECT_EQ(taken.RootMeanSquare(0), made.RootMeanSquare(0));
  EXPECT_EQ(taken.longest(), made.longest());
  EXPECT_EQ(taken.shortest(), made.shortest());
}

TEST(EstimateDiscrepancy, FindsTheMaximumOfAGrid) {
  const Disturbed d({3.0, 1.5}, 0.06, 4);
  const RestrictedLikelihood likelihood = d.Likelihood();
  const DiscrepancyEstimate found = EstimateDiscrepancy(likelihood);
  double best = likelihood.At({});
  for (double x = 0.2; x < 20.0; x *= 1.35) {
    for (double y = 0.2; y < 20.0; y *= 1.35) {
      for (double scale = likelihood.shortest(); scale < likelihood.longest(); scale *= 1.35)
        best = std::max(best, likelihood.At({{x, y}, scale}));
    }
  }
  EXPECT_GE(found.log_likelihood, best - 1e-6);
  EXPECT_LT(found.log_likelihood, best + 2.0);  // the grid is not so coarse
}

TEST(EstimateDiscrepancy, RecoversAmplitudesAndTimeScale) {
  double x = 0.0, y = 0.0, scale = 0.0;
  constexpr int kSeeds = 6;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Disturbed d({4.0, 2.0}, 0.05, seed, 5);
    const DiscrepancyEstimate found = EstimateDiscrepancy(d.Likelihood());
    ASSERT_FALSE(found.noise.IsWhite());
    x += std::log(found.noise.amplitude[0] / 4.0) / kSeeds;
    y += std::log(found.noise.amplitude[1] / 2.0) / kSeeds;
    scale += std::log(found.noise.time_scale / 0.05) / kSeeds;
  }
  EXPECT_NEAR(x, 0.0, 0.25);
  EXPECT_NEAR(y, 0.0, 0.25);
  EXPECT_NEAR(scale, 0.0, 0.25);
}

TEST(EstimateDiscrepancy, IsWhiteWhereTheModelIsRight) {
  int white = 0;
  constexpr int kSeeds = 20;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    white += EstimateDiscrepancy(Disturbed({0.0, 0.0}, 0.05, seed).Likelihood()).noise.IsWhite();
  EXPECT_GE(white, 16);
}

TEST(EstimateDiscrepancy, FromWhatIsKnownEndsAtTheSameMaximum) {
  const Disturbed d({3.0, 1.5}, 0.06, 5);
  const RestrictedLikelihood likelihood = d.Likelihood();
  const DiscrepancyEstimate cold = EstimateDiscrepancy(likelihood);
  NoiseModel near = cold.noise;
  near.time_scale *= 1.5;
  near.amplitude[0] *= 0.7;
  const DiscrepancyEstimate warm = EstimateDiscrepancy(likelihood, near, true);
  EXPECT_NEAR(warm.log_likelihood, cold.log_likelihood, 0.01);
}

}  // namespace
}  // namespace hoplab
