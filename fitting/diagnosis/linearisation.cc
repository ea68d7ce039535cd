#include "fitting/diagnosis/linearisation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "fitting/eliminated_trial.h"
#include "fitting/shared_bounds.h"

namespace hoplab {
namespace {

constexpr double kRankTolerance = 1e-8;

// Orthonormal basis of the span of `columns`, their lengths set aside first.
Eigen::MatrixXd BasisOf(Eigen::MatrixXd columns) {
  for (int k = 0; k < columns.cols(); ++k) {
    const double norm = columns.col(k).norm();
    if (norm > 0.0) columns.col(k) /= norm;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(kRankTolerance);
  if (qr.rank() == 0) return Eigen::MatrixXd(columns.rows(), 0);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

// Mode, phase and hop of an instant.
void Place(const Trajectory& trajectory, double time, RowLabel& label) {
  int hop = 0;
  const Segment* at = nullptr;
  for (const Segment& s : trajectory.segments) {
    const bool stance_before = at && at->mode != Mode::kFlight;
    if (at && stance_before && s.mode == Mode::kFlight) ++hop;
    at = &s;
    if (time < s.end) break;
  }
  if (!at) return;
  label.mode = at->mode;
  label.hop = hop;
  if (at->end > at->begin)
    label.phase = std::clamp((time - at->begin) / (at->end - at->begin), 0.0, 1.0);
}

std::vector<RowLabel> LabelsOf(const FitProblem& problem, const TrialProblem& trial, int index,
                               const TrialEvaluation& e) {
  std::vector<RowLabel> labels;
  labels.reserve(static_cast<std::size_t>(e.residuals.size()));
  const std::size_t channels = problem.channels.size();
  for (std::size_t cell = 0; cell < trial.data.size(); ++cell) {
    if (std::isnan(trial.data[cell])) continue;
    RowLabel label;
    label.trial = index;
    label.channel = static_cast<int>(cell % channels);
    label.time = trial.row_times[cell / channels];
    Place(e.trajectory, label.time, label);
    labels.push_back(label);
  }
  for (const auto* times : {&trial.contact.touchdown_s, &trial.contact.liftoff_s}) {
    for (double t : *times) {
      RowLabel label;
      label.of = RowLabel::Of::kContactTime;
      label.trial = index;
      label.time = t;
      Place(e.trajectory, t, label);
      labels.push_back(label);
    }
  }
  RowLabel prior;
  prior.of = RowLabel::Of::kPrior;
  prior.trial = index;
  labels.resize(static_cast<std::size_t>(e.residuals.size()), prior);
  return labels;
}

LinearisedTrial LineariseTrial(const FitProblem& problem, const std::vector<int>& fitted,
                               int first_tested, const TrialProblem& trial, int index,
                               const Eigen::VectorXd& shared, const OwnValues& start) {
  LinearisedTrial out;
  const TrialEvaluator evaluator(problem, trial);
  TrialEvaluation e;
  evaluator.Evaluate({shared, start, true}, e);
  if (!e.complete) return out;
  const int n = problem.shared_count();
  out.samples = e.data_residuals;
  out.row_count = e.residuals.size();
  out.raw = e.residuals;
  out.labels = LabelsOf(problem, trial, index, e);
  out.fitted.resize(e.residuals.size(), static_cast<Eigen::Index>(fitted.size()));
  for (std::size_t k = 0; k < fitted.size(); ++k)
    out.fitted.col(static_cast<Eigen::Index>(k)) =
        e.jacobian.col(fitted[k]) * problem.shared[static_cast<std::size_t>(fitted[k])].scale;
  out.tested = e.jacobian.middleCols(first_tested, n - first_tested);
  out.tested_square = out.tested.colwise().squaredNorm().transpose();
  out.r = out.raw;
  const Eigen::MatrixXd Q = OwnBasis(trial, e, n);
  out.own_rank = static_cast<int>(Q.cols());
  out.leverage = Q.cols() > 0 ? Eigen::VectorXd(Q.rowwise().squaredNorm())
                              : Eigen::VectorXd::Zero(out.r.size());
  if (Q.cols() == 0) return out;
  out.r -= Q * (Q.transpose() * out.r);
  // Twice is enough: what rounding of the first pass leaves along Q is taken by the second.
  for (int pass = 0; pass < 2; ++pass) {
    out.fitted -= Q * (Q.transpose() * out.fitted);
    out.tested -= Q * (Q.transpose() * out.tested);
  }
  return out;
}

}  // namespace

std::vector<int> FreeShared(const FitProblem& problem, const Eigen::VectorXd& shared) {
  std::vector<int> free;
  for (int k = 0; k < static_cast<int>(shared.size()); ++k) {
    if (!IsHeldOrOnBound(problem.shared[static_cast<std::size_t>(k)], shared[k])) free.push_back(k);
  }
  return free;
}

Linearisation Linearise(const FitProblem& problem, int first_tested,
                        const std::vector<TrialProblem>& trials, const Eigen::VectorXd& shared,
                        const std::vector<OwnValues>& initial_states, int jobs) {
  const std::vector<int> fitted = FreeShared(problem, shared.head(first_tested));
  std::vector<LinearisedTrial> parts(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    parts[i] =
        LineariseTrial(problem, fitted, first_tested, trials[i], i, shared, initial_states[i]);
  });
  return Assemble(parts, static_cast<int>(fitted.size()), problem.shared_count() - first_tested);
}

Linearisation Assemble(const std::vector<LinearisedTrial>& trials, int fitted, int tested) {
  Eigen::Index rows = 0;
  for (const LinearisedTrial& t : trials) rows += t.r.size();
  Linearisation out;
  out.r.resize(rows);
  out.raw.resize(rows);
  out.leverage = Eigen::VectorXd::Zero(rows);
  out.columns.resize(rows, tested);
  out.length = Eigen::VectorXd::Zero(tested);
  Eigen::MatrixXd S(rows, fitted);
  Eigen::Index at = 0;
  bool every_row = true;
  for (const LinearisedTrial& t : trials) {
    const Eigen::Index n = t.r.size();
    if (t.row_count == 0) {
      ++out.trials_left_out;
      continue;
    }
    out.r.segment(at, n) = t.r;
    every_row = every_row && t.raw.size() == n;
    if (t.raw.size() == n) out.raw.segment(at, n) = t.raw;
    if (t.leverage.size() == n) out.leverage.segment(at, n) = t.leverage;
    // Rows of a matrix without columns lie nowhere.
    if (tested > 0) out.columns.middleRows(at, n) = t.tested;
    if (fitted > 0) S.middleRows(at, n) = t.fitted;
    out.length += t.tested_square;
    out.labels.insert(out.labels.end(), t.labels.begin(), t.labels.end());
    out.fitted_rank += t.own_rank;
    out.row_count += static_cast<int>(t.row_count);
    out.samples += t.samples;
    at += n;
  }
  out.length = out.length.cwiseSqrt();
  out.fitted_basis.resize(rows, 0);
  out.along_fitted.resize(0, tested);
  out.fitted_shift = Eigen::MatrixXd::Zero(fitted, tested);
  if (fitted > 0 && rows > 0) {
    out.fitted_basis = BasisOf(S);
    const Eigen::MatrixXd& Q = out.fitted_basis;
    out.fitted_rank += static_cast<int>(Q.cols());
    out.leverage += Q.rowwise().squaredNorm();
    out.r -= Q * (Q.transpose() * out.r);
    out.along_fitted = Eigen::MatrixXd::Zero(Q.cols(), tested);
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::MatrixXd along = Q.transpose() * out.columns;
      out.columns -= Q * along;
      out.along_fitted += along;
    }
    out.fitted_shift =
        -S.completeOrthogonalDecomposition().solve(Eigen::MatrixXd(Q * out.along_fitted));
  }
  if (!every_row) {
    out.raw.resize(0);
    out.leverage.resize(0);
  }
  return out;
}

Eigen::MatrixXd CutToTrials(const Linearisation& at, int column, const std::vector<int>& group_of,
                            int groups, Eigen::VectorXd* squares) {
  // Free of the initial states alone it may be cut to one trial; then the shared values are taken
  // out. (Cut after that, it would keep what the other trials' share of them left in this one.)
  const Eigen::VectorXd whole =
      at.columns.col(column) + at.fitted_basis * at.along_fitted.col(column);
  Eigen::MatrixXd cut = Eigen::MatrixXd::Zero(at.rows(), groups);
  for (int row = 0; row < at.rows(); ++row) {
    const auto trial = static_cast<std::size_t>(at.labels[static_cast<std::size_t>(row)].trial);
    if (group_of[trial] >= 0) cut(row, group_of[trial]) = whole[row];
  }
  if (squares) *squares = cut.colwise().squaredNorm();
  cut -= at.fitted_basis * (at.fitted_basis.transpose() * cut);
  return cut;
}

}  // namespace hoplab
