#include "fitting/uncertainty.h"

#include <Eigen/Dense>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Singular values below this share of the largest are rounding: sensitivities are good to about
// 1e-9 of their column.
constexpr double kRankTolerance = 1e-8;
constexpr double kNormal975 = 1.959963984540054;

// One trial's whitened residuals and sensitivities in scaled units, its starts projected out.
struct Reduced {
  Eigen::VectorXd r;  // residuals orthogonal to what the start can explain
  Eigen::MatrixXd S;  // shared columns, likewise
  int samples = 0;    // of data
  double chi2 = 0.0;  // of data and prior
};

// Empty if the simulation ends before the data.
Reduced ReduceTrial(const FitProblem& problem, const TrialProblem& trial,
                    const Eigen::VectorXd& shared, const std::array<double, 4>& start,
                    const Loss& loss) {
  const TrialEvaluator evaluator(problem, trial);
  TrialEvaluation e;
  evaluator.Evaluate({shared, start, true, loss}, e);
  Reduced out;
  if (!e.complete) return out;
  out.samples = e.data_residuals;
  out.chi2 = e.residuals.squaredNorm();
  const int n = problem.shared_count();
  Eigen::MatrixXd S = e.jacobian.leftCols(n);
  for (int k = 0; k < n; ++k) S.col(k) *= problem.shared[k].scale;
  Eigen::MatrixXd Z(e.jacobian.rows(), 4);
  int free = 0;
  for (int k = 0; k < 4; ++k) {
    if (trial.start_free[k]) Z.col(free++) = e.jacobian.col(n + k) * trial.start_scale[k];
  }
  Z.conservativeResize(Eigen::NoChange, free);
  out.r = e.residuals;
  out.S = S;
  if (free == 0) return out;
  // Columns of very different length (a prior of 1e-9 beside one of 0.02) are scaled first; a
  // direction of the start no sample sees drops out by rank.
  for (int k = 0; k < free; ++k) {
    const double norm = Z.col(k).norm();
    if (norm > 0.0) Z.col(k) /= norm;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Z);
  qr.setThreshold(1e-10);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(Z.rows(), qr.rank());
  out.r -= Q * (Q.transpose() * out.r);
  out.S -= Q * (Q.transpose() * out.S);
  return out;
}

std::pair<double, double> CutInterval(double value, double half, const SharedParameter& s) {
  return {std::max(value - half, s.lower), std::min(value + half, s.upper)};
}

bool AtBound(double value, const SharedParameter& s) {
  const double near = 1e-6 * s.scale;
  return value <= s.lower + near || value >= s.upper - near;
}

}  // namespace

Uncertainty AssessUncertainty(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                              const Eigen::VectorXd& shared,
                              const std::vector<std::array<double, 4>>& starts, const Loss& loss,
                              int jobs) {
  const int n = problem.shared_count();
  std::vector<Reduced> reduced(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    reduced[i] = ReduceTrial(problem, trials[i], shared, starts[i], loss);
  });

  Uncertainty out;
  out.parameters.resize(n);
  long rows = 0, samples = 0, free_starts = 0, priors = 0, used = 0;
  double chi2 = 0.0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    rows += reduced[i].r.size();
    samples += reduced[i].samples;
    chi2 += reduced[i].chi2;
    if (reduced[i].samples == 0) continue;
    ++used;
    for (int k = 0; k < 4; ++k) {
      free_starts += trials[i].start_free[k];
      priors += std::isfinite(trials[i].prior_sigma[k]);
    }
  }

  // Values on a bound are taken as given; what the rest would do if they moved is a question for
  // the profile.
  std::vector<int> active;
  for (int k = 0; k < n; ++k) {
    out.parameters[k].at_bound = AtBound(shared[k], problem.shared[k]);
    if (!out.parameters[k].at_bound) active.push_back(k);
  }
  const int m = static_cast<int>(active.size());

  const double dof = std::max<double>(static_cast<double>(samples + priors - free_starts - m), 1.0);
  out.chi2_per_dof = chi2 / dof;
  out.chi2_p_value = boost::math::cdf(boost::math::complement(boost::math::chi_squared(dof), chi2));
  out.misfit = out.chi2_p_value < 1e-3;

  Eigen::MatrixXd S(rows, m);
  long at = 0;
  for (const Reduced& trial : reduced) {
    if (trial.samples == 0) continue;
    for (int j = 0; j < m; ++j) S.block(at, j, trial.S.rows(), 1) = trial.S.col(active[j]);
    at += trial.S.rows();
  }
  out.covariance = Eigen::MatrixXd::Constant(n, n, kNaN);
  out.correlation = Eigen::MatrixXd::Constant(n, n, kNaN);
  if (m == 0 || rows < m) return out;

  const Eigen::MatrixXd R =
      Eigen::HouseholderQR<Eigen::MatrixXd>(S).matrixQR().topRows(m).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(R, Eigen::ComputeFullV);
  const Eigen::VectorXd& sv = svd.singularValues();
  const Eigen::MatrixXd& V = svd.matrixV();
  Identifiability& id = out.identifiability;
  for (int j = 0; j < m; ++j) id.rank += sv[j] > kRankTolerance * sv[0] && sv[j] > 0.0;
  id.condition_number = id.rank == m ? sv[0] / sv[m - 1] : std::numeric_limits<double>::infinity();
  for (int j = m - 1; j >= 0; --j) {
    const bool unseen = j >= id.rank;
    if (!unseen && 1.0 / sv[j] <= kWeakStdError) break;
    WeakDirection weak{unseen ? 0.0 : sv[j] * sv[j], std::vector<double>(n, 0.0)};
    // The sign is arbitrary: the largest loading is positive.
    Eigen::Index largest = 0;
    V.col(j).cwiseAbs().maxCoeff(&largest);
    const double sign = V(largest, j) < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < m; ++k) weak.loadings[active[k]] = sign * V(k, j);
    id.weak_directions.push_back(std::move(weak));
  }

  // Covariance of the determined part; a value with a share in an unseen direction has none.
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(m, m);
  for (int j = 0; j < id.rank; ++j) C += V.col(j) * V.col(j).transpose() / (sv[j] * sv[j]);
  Eigen::VectorXd unseen_share = Eigen::VectorXd::Zero(m);
  for (int j = id.rank; j < m; ++j) unseen_share += V.col(j).cwiseAbs2();

  // Between trials: C (sum of trial scores squared) C, the scores being what each trial pulls.
  Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(m, m);
  for (const Reduced& trial : reduced) {
    if (trial.samples == 0) continue;
    Eigen::VectorXd score(m);
    for (int j = 0; j < m; ++j) score[j] = trial.S.col(active[j]).dot(trial.r);
    pull += score * score.transpose();
  }
  const double groups = static_cast<double>(used);
  const Eigen::MatrixXd between = groups / std::max(groups - 1.0, 1.0) * C * pull * C;

  for (int a = 0; a < m; ++a) {
    if (unseen_share[a] > 1e-10) continue;
    const SharedParameter& s = problem.shared[active[a]];
    ParameterUncertainty& p = out.parameters[active[a]];
    const double value = shared[active[a]];
    p.std_error = s.scale * std::sqrt(C(a, a));
    p.ci95 = CutInterval(value, kNormal975 * *p.std_error, s);
    if (used >= 3) {
      p.std_error_between_trials = s.scale * std::sqrt(between(a, a));
      const double t = boost::math::quantile(boost::math::students_t(groups - 1.0), 0.975);
      p.ci95_between_trials = CutInterval(value, t * *p.std_error_between_trials, s);
    }
    for (int b = 0; b < m; ++b) {
      if (unseen_share[b] > 1e-10) continue;
      out.covariance(active[a], active[b]) = C(a, b) * s.scale * problem.shared[active[b]].scale;
      out.correlation(active[a], active[b]) = C(a, b) / std::sqrt(C(a, a) * C(b, b));
    }
  }
  return out;
}

}  // namespace hoplab
