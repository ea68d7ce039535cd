#include "fitting/diagnosis/linearisation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace hoplab {
namespace {

constexpr double kRankTolerance = 1e-8;

// One trial's part.
struct Part {
  Eigen::VectorXd raw, r;         // residuals; orthogonal to the start's columns
  Eigen::MatrixXd fitted;         // columns of the fitted shared values, likewise
  Eigen::MatrixXd tested;         // likewise
  Eigen::VectorXd tested_square;  // squared length of the raw tested columns
  Eigen::VectorXd leverage;       // of the start
  std::vector<RowLabel> labels;
  int start_rank = 0;
  int samples = 0;
};

// Orthonormal basis of the span of `columns`, their lengths set aside first.
Eigen::MatrixXd BasisOf(Eigen::MatrixXd columns) {
  for (int k = 0; k < columns.cols(); ++k) {
    const double norm = columns.col(k).norm();
    if (norm > 0.0) columns.col(k) /= norm;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(kRankTolerance);
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

Part LineariseTrial(const FitProblem& problem, const std::vector<int>& fitted, int first_tested,
                    const TrialProblem& trial, int index, const Eigen::VectorXd& shared,
                    const std::array<double, 4>& start) {
  Part part;
  const TrialEvaluator evaluator(problem, trial);
  TrialEvaluation e;
  evaluator.Evaluate({shared, start, true}, e);
  if (!e.complete) return part;
  const int n = problem.shared_count(), tested = n - first_tested;
  part.samples = e.data_residuals;
  part.raw = e.residuals;
  part.labels = LabelsOf(problem, trial, index, e);
  part.fitted.resize(e.residuals.size(), static_cast<Eigen::Index>(fitted.size()));
  for (std::size_t k = 0; k < fitted.size(); ++k)
    part.fitted.col(static_cast<Eigen::Index>(k)) =
        e.jacobian.col(fitted[k]) * problem.shared[fitted[k]].scale;
  part.tested = e.jacobian.middleCols(first_tested, tested);
  part.tested_square = part.tested.colwise().squaredNorm().transpose();
  Eigen::MatrixXd starts(e.residuals.size(), 4);
  int free = 0;
  for (int k = 0; k < 4; ++k) {
    if (trial.start_free[k]) starts.col(free++) = e.jacobian.col(n + k);
  }
  starts.conservativeResize(Eigen::NoChange, free);
  part.r = part.raw;
  part.leverage = Eigen::VectorXd::Zero(part.r.size());
  if (free == 0) return part;
  const Eigen::MatrixXd Q = BasisOf(starts);
  part.start_rank = static_cast<int>(Q.cols());
  part.leverage = Q.rowwise().squaredNorm();
  part.r -= Q * (Q.transpose() * part.r);
  // Twice is enough: what rounding of the first pass leaves along Q is taken by the second.
  for (int pass = 0; pass < 2; ++pass) {
    part.fitted -= Q * (Q.transpose() * part.fitted);
    part.tested -= Q * (Q.transpose() * part.tested);
  }
  return part;
}

bool OnBound(const SharedParameter& s, double value) {
  const double near = 1e-6 * s.scale;
  return value <= s.lower + near || value >= s.upper - near;
}

}  // namespace

Linearisation Linearise(const FitProblem& problem, int first_tested,
                        const std::vector<TrialProblem>& trials, const Eigen::VectorXd& shared,
                        const std::vector<std::array<double, 4>>& starts, int jobs) {
  std::vector<int> fitted;
  for (int k = 0; k < first_tested; ++k) {
    if (!OnBound(problem.shared[k], shared[k])) fitted.push_back(k);
  }
  std::vector<Part> parts(trials.size());
  ParallelFor(static_cast<int>(trials.size()), jobs, [&](int i) {
    parts[i] = LineariseTrial(problem, fitted, first_tested, trials[i], i, shared, starts[i]);
  });

  Eigen::Index rows = 0;
  for (const Part& p : parts) rows += p.r.size();
  const Eigen::Index tested = problem.shared_count() - first_tested;
  Linearisation out;
  out.r.resize(rows);
  out.raw.resize(rows);
  out.leverage.resize(rows);
  out.columns.resize(rows, tested);
  out.length = Eigen::VectorXd::Zero(tested);
  Eigen::MatrixXd S(rows, static_cast<Eigen::Index>(fitted.size()));
  Eigen::Index at = 0;
  for (const Part& p : parts) {
    const Eigen::Index n = p.r.size();
    if (n == 0) {
      ++out.trials_left_out;
      continue;
    }
    out.r.segment(at, n) = p.r;
    out.raw.segment(at, n) = p.raw;
    out.leverage.segment(at, n) = p.leverage;
    // Rows of a matrix without columns lie nowhere.
    if (tested > 0) out.columns.middleRows(at, n) = p.tested;
    if (S.cols() > 0) S.middleRows(at, n) = p.fitted;
    out.length += p.tested_square;
    out.labels.insert(out.labels.end(), p.labels.begin(), p.labels.end());
    out.fitted_rank += p.start_rank;
    out.samples += p.samples;
    at += n;
  }
  out.length = out.length.cwiseSqrt();
  out.fitted_basis.resize(rows, 0);
  out.along_fitted.resize(0, tested);
  if (!fitted.empty() && rows > 0) {
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
  }
  return out;
}

}  // namespace hoplab
