#include "fitting/solve.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/parallel.h"
#include "fitting/reduced_trial.h"

namespace hoplab {
namespace {

std::string Reason(const TrialProblem& trial, const Trajectory& trajectory) {
  char at[48];
  std::snprintf(at, sizeof at, " at %.3f s", trajectory.end_time);
  return trial.file + ": " +
         (IsComplete(trajectory.outcome) ? std::string("other contacts than the trace shows")
                                         : std::string(SentenceOf(trajectory.outcome)) + at);
}

// Simulates every trial once per point, in parallel, before Ceres asks its residual blocks one by
// one: so that sums are formed in one order whatever the number of threads.
class Evaluations : public ceres::EvaluationCallback {
 public:
  Evaluations(const SolveRequest& request)
      : request_(request),
        problem_(*request.problem),
        trials_(*request.trials),
        shared_(problem_.shared_count()),
        evaluations_(trials_.size()),
        run_shared_(Eigen::VectorXd::Constant(shared_.size(), std::nan(""))) {
    for (const TrialProblem& trial : trials_) {
      evaluators_.emplace_back(problem_, trial);
      reduced_.emplace_back(evaluators_.back().residual_count(), evaluators_.back().column_count());
      own_begin_.push_back(own_begin_.back() + trial.own_count());
    }
    own_ = Eigen::VectorXd::Zero(own_begin_.back());
    for (int i = 0; i < problem_.shared_count(); ++i)
      shared_[i] = request.shared[i] / problem_.shared[i].scale;
  }

  // A line search and the step it ends in ask for one point under two names.
  void PrepareForEvaluation(bool jacobians, bool) override {
    const bool known = run_own_.size() == own_.size() && shared_ == run_shared_ && own_ == run_own_;
    if (known && (have_jacobian_ || !jacobians)) return;
    Run(jacobians);
    for (std::size_t i = 0; i < trials_.size(); ++i) {
      if (!evaluations_[i].complete) ++rejected_[Reason(trials_[i], evaluations_[i].trajectory)];
    }
  }
  void Run(bool jacobians) {
    have_jacobian_ = jacobians;
    run_shared_ = shared_;
    run_own_ = own_;
    const Eigen::VectorXd shared = SharedValues();
    ParallelFor(static_cast<int>(trials_.size()), request_.jobs, [&](int i) {
      const OwnValues own = OwnValuesOf(i);
      evaluators_[i].Evaluate({shared, own, jacobians, request_.loss, /*fly_on=*/true,
                               /*whiten=*/false},
                              evaluations_[i]);
      if (evaluations_[i].evaluated)
        reduced_[i].Reduce(evaluations_[i], jacobians, ColumnScales(trials_[i]));
    });
  }

  // Values in their own units.
  Eigen::VectorXd SharedValues() const {
    Eigen::VectorXd values(shared_.size());
    for (int i = 0; i < values.size(); ++i) values[i] = shared_[i] * problem_.shared[i].scale;
    return values;
  }
  OwnValues OwnValuesOf(int trial) const {
    OwnValues values = request_.starts[trial];
    for (int k = 0; k < values.size(); ++k)
      values[k] += own_[own_begin_[trial] + k] * trials_[trial].own[k].scale;
    return values;
  }
  double* shared() { return shared_.data(); }
  double* own(int trial) { return own_.data() + own_begin_[trial]; }
  const TrialEvaluation& evaluation(int trial) const { return evaluations_[trial]; }
  bool AllComplete() const {
    return std::all_of(evaluations_.begin(), evaluations_.end(),
                       [](const TrialEvaluation& e) { return e.complete; });
  }
  double Cost() const {
    double sum = 0.0;
    for (const TrialEvaluation& e : evaluations_) sum += 0.5 * e.residuals.squaredNorm();
    return sum;
  }
  const ReducedTrial& reduced(int trial) const { return reduced_[trial]; }
  const std::map<std::string, int>& rejected() const { return rejected_; }
  void ForgetRejected() { rejected_.clear(); }

 private:
  Eigen::VectorXd ColumnScales(const TrialProblem& trial) const {
    const int n = problem_.shared_count();
    Eigen::VectorXd scale(n + trial.own_count());
    for (int k = 0; k < n; ++k) scale[k] = problem_.shared[k].scale;
    for (int k = 0; k < trial.own_count(); ++k) scale[n + k] = trial.own[k].scale;
    return scale;
  }

  const SolveRequest& request_;
  const FitProblem& problem_;
  const std::vector<TrialProblem>& trials_;
  std::vector<TrialEvaluator> evaluators_;
  std::vector<ReducedTrial> reduced_;
  Eigen::VectorXd shared_;  // value/scale
  /// (value - first value)/scale of all trials in one piece: Ceres takes the blocks of a group in
  /// the order of their addresses, and sums must be formed in one order.
  Eigen::VectorXd own_;
  std::vector<int> own_begin_ = {0};  // one a trial, and the end
  std::vector<TrialEvaluation> evaluations_;
  Eigen::VectorXd run_shared_;  // where `evaluations_` are
  Eigen::VectorXd run_own_;
  bool have_jacobian_ = false;
  std::map<std::string, int> rejected_;
};

// One trial, reduced, as Evaluations holds it. Blocks: shared, own.
class TrialCost : public ceres::CostFunction {
 public:
  TrialCost(int shared_count, int own_count, const Evaluations& evaluations, int index)
      : shared_count_(shared_count), evaluations_(evaluations), index_(index) {
    set_num_residuals(evaluations.reduced(index).rows());
    mutable_parameter_block_sizes()->push_back(shared_count);
    if (own_count > 0) mutable_parameter_block_sizes()->push_back(own_count);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    // Not even a free flight leads on from there: a rejected step; Evaluations keeps the reason.
    if (!evaluations_.evaluation(index_).evaluated) return false;
    const ReducedTrial& trial = evaluations_.reduced(index_);
    const int rows = num_residuals();
    std::copy(trial.residuals().data(), trial.residuals().data() + rows, residuals);
    if (!jacobians) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto own_count = trial.jacobian().cols() - shared_count_;
    if (jacobians[0])
      Eigen::Map<RowMajor>(jacobians[0], rows, shared_count_) =
          trial.jacobian().leftCols(shared_count_);
    if (own_count > 0 && jacobians[1])
      Eigen::Map<RowMajor>(jacobians[1], rows, own_count) = trial.jacobian().rightCols(own_count);
    return true;
  }

 private:
  int shared_count_;
  const Evaluations& evaluations_;
  int index_;
};

class Watch : public ceres::IterationCallback {
 public:
  explicit Watch(const SolveRequest& request) : request_(request) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (request_.progress) request_.progress(summary.iteration, summary.cost);
    if (request_.stop && *request_.stop) return ceres::SOLVER_ABORT;
    // A step not taken has the cost of where it would have led.
    costs_.push_back(costs_.empty() ? summary.cost : std::fmin(costs_.back(), summary.cost));
    return IsHopeless() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  // Too far above for ten more iterations at the pace of the last three.
  bool IsHopeless() const {
    constexpr std::size_t kPaceOver = 3;
    constexpr double kAhead = 10.0;
    if (costs_.size() <= kPaceOver) return false;
    const double pace = (costs_[costs_.size() - 1 - kPaceOver] - costs_.back()) / kPaceOver;
    return costs_.back() - kAhead * pace > request_.give_up_above;
  }

  std::vector<double> costs_;
  const SolveRequest& request_;
};

void HoldComponents(ceres::Problem& problem, double* block, int size,
                    const std::vector<int>& held) {
  if (held.empty()) return;
  if (static_cast<int>(held.size()) == size)
    problem.SetParameterBlockConstant(block);
  else
    problem.SetManifold(block, new ceres::SubsetManifold(size, held));
}

SolveStatus StatusOf(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      return SolveStatus::kConverged;
    case ceres::NO_CONVERGENCE:
      return SolveStatus::kIterationLimit;
    case ceres::USER_SUCCESS:
      return SolveStatus::kGaveUp;
    case ceres::USER_FAILURE:
      return SolveStatus::kInterrupted;
    default:
      return SolveStatus::kFailed;
  }
}

// One run of Ceres.
SolveResult SolveOnce(const SolveRequest& request) {
  const FitProblem& problem = *request.problem;
  const std::vector<TrialProblem>& trials = *request.trials;
  HOPLAB_CHECK(request.starts.size() == trials.size());
  HOPLAB_CHECK(request.shared.size() == problem.shared_count());

  Evaluations evaluations(request);
  SolveResult result;
  result.shared = request.shared;
  result.starts = request.starts;

  evaluations.Run(false);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialEvaluation& e = evaluations.evaluation(static_cast<int>(i));
    if (e.evaluated) continue;
    result.status = SolveStatus::kNoStart;
    result.message = Reason(trials[i], e.trajectory);
    return result;
  }
  if (evaluations.Cost() > request.start_below) {
    result.status = SolveStatus::kNoStart;
    result.message = "the search would begin too far away";
    return result;
  }

  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &evaluations;
  ceres::Problem ceres_problem(problem_options);
  // Own values belong to one trial each: Ceres eliminates them trial by trial, so that the cost of
  // a step grows with the number of trials and no faster.
  auto* ordering = new ceres::ParameterBlockOrdering;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const int index = static_cast<int>(i), own_count = trials[i].own_count();
    std::vector<double*> blocks = {evaluations.shared()};
    if (own_count > 0) blocks.push_back(evaluations.own(index));
    ceres_problem.AddResidualBlock(
        new TrialCost(problem.shared_count(), own_count, evaluations, index), nullptr, blocks);
    if (own_count == 0) continue;
    ordering->AddElementToGroup(evaluations.own(index), 0);
    std::vector<int> held;
    for (int k = 0; k < own_count; ++k) {
      if (request.hold_starts || !trials[i].own[k].free) held.push_back(k);
    }
    HoldComponents(ceres_problem, evaluations.own(index), own_count, held);
  }
  ordering->AddElementToGroup(evaluations.shared(), 1);
  std::vector<int> held = request.held;
  if (request.hold_shared) {
    held.clear();
    for (int k = 0; k < problem.shared_count(); ++k) held.push_back(k);
  }
  HoldComponents(ceres_problem, evaluations.shared(), problem.shared_count(), held);
  if (!request.hold_shared) {
    for (int k = 0; k < problem.shared_count(); ++k) {
      const SharedParameter& s = problem.shared[k];
      ceres_problem.SetParameterLowerBound(evaluations.shared(), k, s.lower / s.scale);
      ceres_problem.SetParameterUpperBound(evaluations.shared(), k, s.upper / s.scale);
    }
  }

  ceres::Solver::Options options;
  const bool eliminates = !request.hold_shared && !request.hold_starts;
  options.linear_solver_type = eliminates ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
  options.linear_solver_ordering.reset(ordering);
  options.max_num_iterations = request.max_iterations;
  options.function_tolerance = request.function_tolerance;
  options.parameter_tolerance = 1e-11;
  options.gradient_tolerance = 1e-12;
  // Beyond a fall the cost jumps where the sequence of events changes: such a step only shrinks the
  // region.
  options.max_num_consecutive_invalid_steps = 60;
  options.line_search_interpolation_type = ceres::QUADRATIC;  // cubic asks for Jacobians
  options.max_num_line_search_step_size_iterations = 5;       // the trust region shrinks after that
  options.logging_type = ceres::SILENT;
  Watch watch(request);
  options.callbacks.push_back(&watch);
  evaluations.ForgetRejected();

  // What Ceres logs of a failed step its summary says as well; it is no user's message.
  static const bool silent = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  static_cast<void>(silent);

  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);

  result.status = StatusOf(summary);
  result.shared = evaluations.SharedValues();
  for (std::size_t i = 0; i < trials.size(); ++i)
    result.starts[i] = evaluations.OwnValuesOf(static_cast<int>(i));
  result.cost = summary.final_cost + summary.fixed_cost;
  result.iterations = static_cast<int>(summary.iterations.size());
  result.rejected = evaluations.rejected();
  evaluations.PrepareForEvaluation(false, false);
  result.complete = evaluations.AllComplete();
  if (result.status == SolveStatus::kFailed) result.message = summary.message;
  return result;
}

// The shared values a result has on a bound, besides those held already.
std::vector<int> OnBounds(const SolveRequest& request, const SolveResult& result) {
  std::vector<int> on;
  for (int k = 0; k < request.problem->shared_count(); ++k) {
    const SharedParameter& s = request.problem->shared[k];
    const double near = 1e-9 * s.scale;
    const bool bound = result.shared[k] <= s.lower + near || result.shared[k] >= s.upper - near;
    const bool held = std::find(request.held.begin(), request.held.end(), k) != request.held.end();
    if (bound && !held) on.push_back(k);
  }
  return on;
}

// Which of the values `on` a bound the cost would pull back inside, by its gradient at `at`.
std::vector<int> PulledInside(const SolveRequest& request, const SolveResult& at,
                              const std::vector<int>& on) {
  SolveRequest there = request;
  there.shared = at.shared;
  there.starts = at.starts;
  Evaluations evaluations(there);
  evaluations.Run(true);
  std::vector<int> inside;
  for (int k : on) {
    const SharedParameter& s = request.problem->shared[static_cast<std::size_t>(k)];
    double gradient = 0.0;
    for (std::size_t i = 0; i < request.trials->size(); ++i) {
      const TrialEvaluation& e = evaluations.evaluation(static_cast<int>(i));
      if (e.evaluated) gradient += e.jacobian.col(k).dot(e.residuals);
    }
    const bool on_lower = at.shared[k] <= s.lower + 1e-9 * s.scale;
    if (on_lower ? gradient < 0.0 : gradient > 0.0) inside.push_back(k);
  }
  return inside;
}

// Goes on from where `best` ended with `held` values held; `best` becomes what comes out if its
// cost is less. Whether it gained.
bool GoOn(const SolveRequest& request, const std::vector<int>& held, SolveResult& best) {
  // Below this share of the cost a gain is the solver's own tolerance.
  constexpr double kGain = 1e-9;
  SolveRequest again = request;
  again.held.insert(again.held.end(), held.begin(), held.end());
  again.shared = best.shared;
  again.starts = best.starts;
  SolveResult next = SolveOnce(again);
  if (!IsUsable(next.status)) return false;
  const bool gained = next.cost < best.cost * (1.0 - kGain);
  // At the optimum the costs of two runs differ by rounding: the one that says it has converged
  // counts, or a run cut short there would never be called converged.
  if (!(next.cost <= best.cost * (1.0 + kGain))) return false;
  next.iterations += best.iterations;
  for (const auto& [reason, count] : best.rejected) next.rejected[reason] += count;
  best = std::move(next);
  return gained;
}

}  // namespace

std::string_view NameOf(SolveStatus status) {
  switch (status) {
    case SolveStatus::kConverged:
      return "converged";
    case SolveStatus::kIterationLimit:
      return "iteration_limit";
    case SolveStatus::kGaveUp:
      return "gave_up";
    case SolveStatus::kNoStart:
      return "no_start";
    case SolveStatus::kFailed:
      return "failed";
    case SolveStatus::kInterrupted:
      return "interrupted";
  }
  return "";
}

bool IsUsable(SolveStatus status) {
  return status == SolveStatus::kConverged || status == SolveStatus::kIterationLimit ||
         status == SolveStatus::kGaveUp;
}

SolveResult Solve(const SolveRequest& request) {
  if (request.hold_shared) return SolveOnce(request);
  // A trust region cut by a bound crawls: the step it would take is projected, and what is left of
  // it gains little. So the first run is short; what lies on a bound then, and is not pulled back
  // inside by the gradient, is held there while the rest is solved, until nothing changes.
  constexpr int kFirstIterations = 6, kMaxRounds = 6;
  SolveRequest first = request;
  first.max_iterations = std::min(request.max_iterations, kFirstIterations);
  SolveResult best = SolveOnce(first);
  std::vector<int> held;
  for (int round = 0; round < kMaxRounds && IsUsable(best.status); ++round) {
    if (best.status == SolveStatus::kGaveUp) break;
    std::vector<int> on = OnBounds(request, best);
    if (!on.empty()) {
      const std::vector<int> inside = PulledInside(request, best, on);
      std::erase_if(
          on, [&](int k) { return std::find(inside.begin(), inside.end(), k) != inside.end(); });
    }
    const bool settled = best.status == SolveStatus::kConverged && on == held;
    if (settled || request.max_iterations <= kFirstIterations) break;
    held = on;
    SolveRequest rest = request;
    rest.max_iterations = request.max_iterations - best.iterations;
    if (rest.max_iterations < 1) {
      best.status = SolveStatus::kIterationLimit;
      break;
    }
    if (!GoOn(rest, held, best) && best.status != SolveStatus::kConverged) break;
  }
  return best;
}

}  // namespace hoplab
