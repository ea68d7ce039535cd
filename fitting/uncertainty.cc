#include "fitting/uncertainty.h"

#include <Eigen/Dense>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "base/nan.h"
#include "base/parallel.h"
#include "fitting/eliminated_trial.h"
#include "fitting/shared_bounds.h"
#include "fitting/trial_noise.h"

namespace hoplab {
namespace {

// Singular values below this share of the largest are rounding: sensitivities are good to about
// 1e-9 of their column.
constexpr double kIdentifiedRankTolerance = 1e-8;
constexpr double kNormal975 = 1.959963984540054;

struct Reduced {
  EliminatedTrial trial;
  int samples = 0;    // of data; 0: the simulation ends before them
  double chi2 = 0.0;  // of data over the channels' sigma, and of priors
  /// columns' K columns, K the discrepancy's covariance of the trial's rows in units of sigma;
  /// empty under white noise.
  Eigen::MatrixXd smooth;
};

Eigen::MatrixXd SmoothSpread(const TrialEvaluator& evaluator, const NoiseModel& noise,
                             const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  const std::vector<ChannelRows>& channels = evaluator.channel_rows();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const double ratio = AmplitudeIn(noise, evaluator.trial(), c);
    if (ratio > 0.0)
      sum += MaternProduct(channels[c].times, channels[c].rows, ratio, noise.time_scale, columns);
  }
  return sum;
}

Reduced ReduceTrial(const FitProblem& problem, const TrialProblem& trial,
                    const Eigen::VectorXd& shared, const OwnValues& start, const Loss& loss,
                    const std::vector<KeptColumn>& columns) {
  const TrialEvaluator evaluator(problem, trial);
  TrialEvaluation e;
  evaluator.Evaluate({shared, start, true, loss, /*fly_on=*/false, /*whiten=*/false}, e);
  Reduced out;
  if (!e.complete) return out;
  out.samples = e.data_residuals;
  const Eigen::Index priors = e.residuals.size() - e.data_residuals;
  out.chi2 = e.white_square + e.residuals.tail(priors).squaredNorm();
  out.trial = EliminateOwn(trial, e, problem.shared_count(), columns);
  if (!problem.noise.IsWhite()) {
    const Eigen::MatrixXd Q = OwnBasis(trial, e, problem.shared_count());
    const auto n = static_cast<Eigen::Index>(columns.size());
    out.smooth =
        SmoothSpread(evaluator, problem.noise, ProjectedColumns(Q, e, columns).leftCols(n));
  }
  return out;
}

std::pair<double, double> CutInterval(double value, double half, const SharedParameter& s) {
  return {std::max(value - half, s.lower), std::min(value + half, s.upper)};
}

// What the trials together know of the values that are not at a bound, the `active` ones.
struct Known {
  std::vector<int> active;
  std::vector<Reduced> reduced;
  std::vector<EliminatedTrial> parts;  // of those that reach their data
  long samples = 0, own_rank = 0, priors = 0;
  double chi2 = 0.0;
};

Known Gather(const FitProblem& problem, const std::vector<TrialProblem>& trials,
             const Eigen::VectorXd& shared, const std::vector<OwnValues>& initial_states,
             const Loss& loss, int jobs) {
  Known known;
  std::vector<KeptColumn> columns;
  for (int k = 0; k < problem.shared_count(); ++k) {
    if (IsHeldOrOnBound(problem.shared[k], shared[k])) continue;
    known.active.push_back(k);
    columns.push_back({k, problem.shared[k].scale});
  }
  std::vector<Reduced>& reduced = known.reduced;
  reduced.resize(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    reduced[i] = ReduceTrial(problem, trials[i], shared, initial_states[i], loss, columns);
  });
  for (std::size_t i = 0; i < trials.size(); ++i) {
    known.samples += reduced[i].samples;
    known.chi2 += reduced[i].chi2;
    if (reduced[i].samples == 0) continue;
    known.parts.push_back(reduced[i].trial);
    known.own_rank += reduced[i].trial.own_rank;
    known.priors += std::ssize(trials[i].shared_priors);
    for (const OwnParameter& o : trials[i].own) known.priors += std::isfinite(o.prior_sigma);
  }
  return known;
}

// Of m values, from the singular values and vectors of what is known of them.
void FindWeakDirections(const Eigen::VectorXd& sv, const Eigen::MatrixXd& V,
                        const std::vector<int>& active, int count, Identifiability& id) {
  const int m = static_cast<int>(active.size());
  for (int j = 0; j < m; ++j) id.rank += sv[j] > kIdentifiedRankTolerance * sv[0] && sv[j] > 0.0;
  id.condition_number = id.rank == m ? sv[0] / sv[m - 1] : std::numeric_limits<double>::infinity();
  for (int j = m - 1; j >= 0; --j) {
    const bool unseen = j >= id.rank;
    if (!unseen && 1.0 / sv[j] <= kWeakStdError) break;
    WeakDirection weak{unseen ? 0.0 : sv[j] * sv[j], std::vector<double>(count, 0.0)};
    // The sign is arbitrary: the largest loading is positive.
    Eigen::Index largest = 0;
    V.col(j).cwiseAbs().maxCoeff(&largest);
    const double sign = V(largest, j) < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < m; ++k) weak.loadings[active[k]] = sign * V(k, j);
    id.weak_directions.push_back(std::move(weak));
  }
}

// Covariances of the active values, over their scales.
struct Covariances {
  Eigen::MatrixXd C;       // of white noise, of the determined part
  Eigen::MatrixXd spread;  // of all noise
  Eigen::MatrixXd between;
  Eigen::VectorXd unseen_share;  // of a value, in directions that nothing determines
};

Covariances CovariancesOf(const Known& known, const Eigen::VectorXd& sv, const Eigen::MatrixXd& V,
                          int rank) {
  const int m = static_cast<int>(known.active.size());
  Covariances out;
  // Of the determined part; a value with a share in an unseen direction has none.
  Eigen::MatrixXd& C = out.C = Eigen::MatrixXd::Zero(m, m);
  for (int j = 0; j < rank; ++j) C += V.col(j) * V.col(j).transpose() / (sv[j] * sv[j]);
  out.unseen_share = Eigen::VectorXd::Zero(m);
  for (int j = rank; j < m; ++j) out.unseen_share += V.col(j).cwiseAbs2();

  // The values are those of least squares; a discrepancy of covariance K beside the white noise
  // spreads them by C S'(I + K) S C instead of C = (S'S)^-1. What a model lacks, it lacks in every
  // trial: its trials' discrepancies push a value the same way, and more trials do not average it
  // out. So their pushes, of standard deviation s_i, add up as sum s_i, the most that any
  // correlation between trials allows, and not as the root of sum s_i^2.
  Eigen::VectorXd pushed = Eigen::VectorXd::Zero(m);
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(m, m);
  for (const Reduced& r : known.reduced) {
    if (r.smooth.size() == 0) continue;
    const Eigen::MatrixXd one = C * r.smooth * C;
    apart += one;
    pushed += one.diagonal().cwiseMax(0.0).cwiseSqrt();
  }
  const Eigen::VectorXd alone = apart.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::VectorXd wider = (alone.array() > 0.0).select(pushed.cwiseQuotient(alone), 1.0);
  out.spread = C + wider.asDiagonal() * apart * wider.asDiagonal();

  // Between trials: C (sum of trial scores squared) C, the scores being what each trial pulls.
  Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(m, m);
  for (const EliminatedTrial& trial : known.parts) {
    const Eigen::VectorXd score = trial.columns.transpose() * trial.residuals;
    pull += score * score.transpose();
  }
  const double groups = static_cast<double>(known.parts.size());
  out.between = groups / std::max(groups - 1.0, 1.0) * C * pull * C;
  return out;
}

void FillIn(const FitProblem& problem, const Eigen::VectorXd& shared, const Known& known,
            const Covariances& c, Uncertainty& out) {
  const std::vector<int>& active = known.active;
  const int m = static_cast<int>(active.size());
  const double groups = static_cast<double>(known.parts.size());
  for (int a = 0; a < m; ++a) {
    if (c.unseen_share[a] > 1e-10) continue;
    const SharedParameter& s = problem.shared[active[a]];
    ParameterUncertainty& p = out.parameters[active[a]];
    const double value = shared[active[a]];
    p.std_error = s.scale * std::sqrt(c.spread(a, a));
    p.inflation = c.spread(a, a) / c.C(a, a);
    p.ci95 = CutInterval(value, kNormal975 * *p.std_error, s);
    if (known.parts.size() >= 3) {
      p.std_error_between_trials = s.scale * std::sqrt(c.between(a, a));
      const double t = boost::math::quantile(boost::math::students_t(groups - 1.0), 0.975);
      p.ci95_between_trials = CutInterval(value, t * *p.std_error_between_trials, s);
    }
    for (int b = 0; b < m; ++b) {
      if (c.unseen_share[b] > 1e-10) continue;
      const double scale = s.scale * problem.shared[active[b]].scale;
      out.covariance(active[a], active[b]) = c.spread(a, b) * scale;
      out.correlation(active[a], active[b]) =
          c.spread(a, b) / std::sqrt(c.spread(a, a) * c.spread(b, b));
    }
  }
}

// Chi-square against what noise leaves of it, where the data tell `rank` of the shared values.
void TestSquare(const Known& known, Eigen::Index rank, Uncertainty& out) {
  const long rows = known.samples + known.priors - known.own_rank;
  const double dof = std::max(static_cast<double>(rows - rank), 1.0);
  out.chi2_per_dof = known.chi2 / dof;
  out.chi2_p_value =
      boost::math::cdf(boost::math::complement(boost::math::chi_squared(dof), known.chi2));
  out.misfit = out.chi2_p_value < 1e-3;
}

// Whether another fit is no worse than `known` for certain: not in all by what the trials differ
// in it, nor in one of them by more than the trial that is missed most is missed anyway.
bool FitsAsWell(const Known& other, const Known& known) {
  if (other.samples != known.samples) return false;
  constexpr double kNoise = kNormal975 * kNormal975;
  double missed = kNoise;
  std::vector<double> worse;
  for (std::size_t i = 0; i < known.reduced.size(); ++i) {
    const Reduced& trial = known.reduced[i];
    if (trial.samples == 0) continue;
    worse.push_back(other.reduced[i].chi2 - trial.chi2);
    missed = std::max(missed, trial.chi2 - static_cast<double>(trial.samples));
  }
  const auto n = static_cast<double>(worse.size());
  const Eigen::Map<const Eigen::ArrayXd> w(worse.data(), std::ssize(worse));
  if (w.sum() <= kNoise) return true;
  if (n < 2.0 || !(w.maxCoeff() <= missed)) return false;
  const double error = std::sqrt((w - w.mean()).square().sum() / (n * (n - 1.0)));
  return w.mean() <= error * boost::math::quantile(boost::math::students_t(n - 1.0), 0.975);
}

// A value with a threshold on both sides of whose null the range goes on may be known from one
// side alone: a torque limit that is not reached changes nothing, however high it is. Where an end
// of the range fits as well as the value, all else as it is, its intervals reach that end.
void ReachBeyondThresholds(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                           const Eigen::VectorXd& shared,
                           const std::vector<OwnValues>& initial_states, const Loss& loss, int jobs,
                           const Known& known, Uncertainty& out) {
  for (const int k : known.active) {
    const SharedParameter& s = problem.shared[k];
    ParameterUncertainty& p = out.parameters[k];
    if (!s.has_threshold || s.lower >= 0.0 || !p.ci95) continue;
    for (const bool upper : {false, true}) {
      Eigen::VectorXd end = shared;
      end[k] = upper ? s.upper : s.lower;
      if (!FitsAsWell(Gather(problem, trials, end, initial_states, loss, jobs), known)) continue;
      for (auto* interval : {&p.ci95, &p.ci95_between_trials})
        if (*interval) (upper ? (*interval)->second : (*interval)->first) = end[k];
    }
  }
}

}  // namespace

const std::optional<std::pair<double, double>>& ParameterUncertainty::Wider() const {
  const auto width = [](const auto& interval) { return interval->second - interval->first; };
  const bool between = ci95_between_trials && (!ci95 || width(ci95_between_trials) > width(ci95));
  return between ? ci95_between_trials : ci95;
}

Uncertainty AssessUncertainty(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                              const Eigen::VectorXd& shared,
                              const std::vector<OwnValues>& initial_states, const Loss& loss,
                              int jobs) {
  const int n = problem.shared_count();
  Uncertainty out;
  out.parameters.resize(n);
  // Values on a bound are taken as given; what the rest would do if they moved is a question for
  // the profile.
  for (int k = 0; k < n; ++k)
    out.parameters[k].at_bound = IsHeldOrOnBound(problem.shared[k], shared[k]);
  const Known known = Gather(problem, trials, shared, initial_states, loss, jobs);
  const int m = static_cast<int>(known.active.size());
  const EliminatedTrial all = Stacked(known.parts);
  const Eigen::MatrixXd& S = all.columns;
  out.covariance = Eigen::MatrixXd::Constant(n, n, kNaN);
  out.correlation = Eigen::MatrixXd::Constant(n, n, kNaN);
  if (m == 0 || S.rows() < m) {
    TestSquare(known, std::min<Eigen::Index>(m, S.rows()), out);
    return out;
  }

  const Eigen::MatrixXd R =
      Eigen::HouseholderQR<Eigen::MatrixXd>(S).matrixQR().topRows(m).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(R, Eigen::ComputeFullV);
  FindWeakDirections(svd.singularValues(), svd.matrixV(), known.active, n, out.identifiability);
  TestSquare(known, out.identifiability.rank, out);
  FillIn(problem, shared, known,
         CovariancesOf(known, svd.singularValues(), svd.matrixV(), out.identifiability.rank), out);
  ReachBeyondThresholds(problem, trials, shared, initial_states, loss, jobs, known, out);
  return out;
}

}  // namespace hoplab
