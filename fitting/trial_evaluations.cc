#include "fitting/trial_evaluations.h"

#include <Eigen/QR>
#include <algorithm>
#include <cstdio>

#include "base/check.h"
#include "base/parallel.h"
#include "fitting/run_end.h"
#include "model/mechanism_traits.h"

namespace hoplab {

TrialEvaluations::TrialEvaluations(const SolveRequest& request)
    : request_(request),
      problem_(*request.problem),
      trials_(*request.trials),
      evaluations_(trials_.size()),
      workspaces_(trials_.size()),
      shared_(problem_.shared_count()) {
  HOPLAB_CHECK(request.initial_states.size() == trials_.size());
  HOPLAB_CHECK(request.shared.size() == problem_.shared_count());
  for (const TrialProblem& trial : trials_) {
    evaluators_.emplace_back(problem_, trial);
    for (Point& point : points_)
      point.reduced.emplace_back(evaluators_.back().residual_count(),
                                 evaluators_.back().column_count());
    own_begin_.push_back(own_begin_.back() + trial.own_count());
  }
  own_ = Eigen::VectorXd::Zero(own_begin_.back());
  for (int i = 0; i < problem_.shared_count(); ++i)
    shared_[i] = request.shared[i] / problem_.shared[static_cast<std::size_t>(i)].scale;
}

void TrialEvaluations::PrepareForEvaluation(bool jacobians, bool /*new_point*/) {
  const int place = points_[kept_].Is(shared_, own_) ? kept_ : 1 - kept_;
  Point& point = points_[place];
  at_ = &point;
  if (!point.Is(shared_, own_)) {
    Run(point);
    for (int i = 0; i < static_cast<int>(trials_.size()); ++i) {
      if (!evaluations_[static_cast<std::size_t>(i)].complete) ++rejected_[ReasonOf(i)];
    }
  }
  if (jacobians) kept_ = place;
}

void TrialEvaluations::Run(Point& point) {
  const std::size_t n = trials_.size();
  point.shared = shared_;
  point.own = own_;
  point.evaluated.assign(n, 0);
  const Eigen::VectorXd shared = SharedValues();
  ParallelFor(static_cast<int>(n), request_.jobs, [&](int trial) {
    const auto i = static_cast<std::size_t>(trial);
    TrialEvaluation& e = evaluations_[i];
    const OwnValues own = OwnValuesOf(trial);
    EvaluationRequest request{shared,
                              own,
                              /*want_jacobian=*/true,
                              request_.loss,
                              /*fly_on=*/true,
                              /*whiten=*/false};
    if (HoldsManyShared(trial))
      request.only = ColumnRange{problem_.shared_count(), trials_[i].own_count()};
    evaluators_[i].Evaluate(request, e);
    if (!e.evaluated) return;
    if (request.only) PutAfterShared(e.jacobian);
    point.reduced[i].Reduce(e, ColumnScales(trials_[i]), workspaces_[i]);
    e.evaluated = point.reduced[i].residuals().allFinite();
    e.complete = e.complete && e.evaluated;
    point.evaluated[i] = e.evaluated;
  });
  point.cost = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    if (point.evaluated[i]) point.cost += 0.5 * point.reduced[i].residuals().squaredNorm();
  point.complete = std::all_of(evaluations_.begin(), evaluations_.end(),
                               [](const TrialEvaluation& e) { return e.complete; });
}

// Whether the columns of held shared values would take the simulator another run.
bool TrialEvaluations::HoldsManyShared(int trial) const {
  const int own = trials_[static_cast<std::size_t>(trial)].own_count();
  return request_.hold_shared && TraitsOf(problem_.law).has_costly_runs && own <= kWideJet &&
         own + problem_.shared_count() > kWideJet;
}

// The columns of held values are nobody's: zeros.
void TrialEvaluations::PutAfterShared(RowMajorMatrix& own) const {
  RowMajorMatrix whole = RowMajorMatrix::Zero(own.rows(), problem_.shared_count() + own.cols());
  whole.rightCols(own.cols()) = own;
  own = std::move(whole);
}

Eigen::VectorXd TrialEvaluations::SharedValues(const Eigen::VectorXd& over_scale) const {
  Eigen::VectorXd values(over_scale.size());
  for (int i = 0; i < values.size(); ++i)
    values[i] = over_scale[i] * problem_.shared[static_cast<std::size_t>(i)].scale;
  return values;
}

void TrialEvaluations::TakeTried(const std::vector<int>& places) {
  for (const int k : places) shared_[k] = Tried().shared[k];
}

OwnValues TrialEvaluations::OwnValuesOf(int trial) const {
  const auto i = static_cast<std::size_t>(trial);
  OwnValues values = request_.initial_states[i];
  for (int k = 0; k < values.size(); ++k)
    values[k] += own_[own_begin_[i] + k] * trials_[i].own[static_cast<std::size_t>(k)].scale;
  return values;
}

void TrialEvaluations::MoveTo(const Eigen::VectorXd& shared, const std::vector<OwnValues>& own) {
  for (int i = 0; i < problem_.shared_count(); ++i)
    shared_[i] = shared[i] / problem_.shared[static_cast<std::size_t>(i)].scale;
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    for (int k = 0; k < trials_[i].own_count(); ++k)
      own_[own_begin_[i] + k] = (own[i][k] - request_.initial_states[i][k]) /
                                trials_[i].own[static_cast<std::size_t>(k)].scale;
  }
}

double TrialEvaluations::Gradient(int shared) const {
  double sum = 0.0;
  const Point& kept = points_[kept_];
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    if (kept.evaluated[i])
      sum += kept.reduced[i].jacobian().col(shared).dot(kept.reduced[i].residuals());
  }
  return sum;
}

// A trial's own values are eliminated one trial after the other, by an orthogonal transformation of
// its rows, so that the work grows with the number of trials and no faster.
double TrialEvaluations::PredictedGain(const std::vector<int>& held) const {
  const Point& kept = points_[kept_];
  std::vector<int> shared;
  for (int k = 0; k < problem_.shared_count(); ++k)
    if (std::find(held.begin(), held.end(), k) == held.end()) shared.push_back(k);
  const auto n = static_cast<Eigen::Index>(shared.size());
  Eigen::Index rows = 0;
  for (const ReducedTrial& trial : kept.reduced) rows += trial.rows();
  Eigen::MatrixXd rest(rows, n);
  Eigen::VectorXd residuals(rows);
  rows = 0;
  double gain = 0.0;
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    if (!kept.evaluated[i]) continue;
    const ReducedTrial& trial = kept.reduced[i];
    Eigen::MatrixXd by_shared = trial.jacobian()(Eigen::all, shared);
    Eigen::VectorXd r = trial.residuals();
    const std::vector<int> own = FreeOwnColumns(trials_[i]);
    const auto along = std::min<Eigen::Index>(static_cast<Eigen::Index>(own.size()), r.size());
    if (along > 0) {
      const Eigen::HouseholderQR<Eigen::MatrixXd> qr(trial.jacobian()(Eigen::all, own));
      by_shared.applyOnTheLeft(qr.householderQ().adjoint());
      r.applyOnTheLeft(qr.householderQ().adjoint());
      gain += 0.5 * r.head(along).squaredNorm();
    }
    const Eigen::Index left = r.size() - along;
    rest.middleRows(rows, left) = by_shared.bottomRows(left);
    residuals.segment(rows, left) = r.tail(left);
    rows += left;
  }
  if (n == 0 || rows == 0) return gain;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rest.topRows(rows));
  Eigen::VectorXd r = residuals.head(rows);
  r.applyOnTheLeft(qr.householderQ().adjoint());
  return gain + 0.5 * r.head(std::min(n, rows)).squaredNorm();
}

// Those of a reduced trial's Jacobian.
std::vector<int> TrialEvaluations::FreeOwnColumns(const TrialProblem& trial) const {
  std::vector<int> columns;
  for (int k = 0; k < trial.own_count(); ++k)
    if (!request_.hold_initial_states && trial.own[static_cast<std::size_t>(k)].free)
      columns.push_back(problem_.shared_count() + k);
  return columns;
}

void TrialEvaluations::Copy(int trial, double* residuals, double* by_shared, double* by_own) const {
  const ReducedTrial& reduced = at_->reduced[static_cast<std::size_t>(trial)];
  const int rows = reduced.rows();
  std::copy(reduced.residuals().data(), reduced.residuals().data() + rows, residuals);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Index shared = shared_.size(), own = reduced.jacobian().cols() - shared;
  if (by_shared)
    Eigen::Map<RowMajor>(by_shared, rows, shared) = reduced.jacobian().leftCols(shared);
  if (by_own && own > 0)
    Eigen::Map<RowMajor>(by_own, rows, own) = reduced.jacobian().rightCols(own);
}

std::string TrialEvaluations::ReasonOf(int trial) const {
  const auto i = static_cast<std::size_t>(trial);
  const Trajectory& trajectory = evaluations_[i].trajectory;
  char at[48];
  std::snprintf(at, sizeof at, " at %.3f s", trajectory.end_time);
  const std::string of = trials_[i].file + ": ";
  if (!hoplab::IsComplete(trajectory.outcome))
    return of + "the simulation " +
           WhyEnded(trajectory, problem_.effects,
                    {trials_[i].start.data(), static_cast<std::size_t>(trials_[i].start.size())}) +
           at;
  return of + (evaluations_[i].evaluated ? "other contacts than the trace shows"
                                         : "residuals or derivatives that are no numbers");
}

Eigen::VectorXd TrialEvaluations::ColumnScales(const TrialProblem& trial) const {
  const int n = problem_.shared_count();
  Eigen::VectorXd scale(n + trial.own_count());
  for (int k = 0; k < n; ++k) scale[k] = problem_.shared[static_cast<std::size_t>(k)].scale;
  for (int k = 0; k < trial.own_count(); ++k)
    scale[n + k] = trial.own[static_cast<std::size_t>(k)].scale;
  return scale;
}

}  // namespace hoplab
