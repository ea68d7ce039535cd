#include "fitting/ceres_run.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "fitting/deviation.h"

namespace hoplab {
namespace {

// One trial, reduced. Blocks: shared, own.
class TrialCost : public ceres::CostFunction {
 public:
  TrialCost(int shared_count, int own_count, const TrialEvaluations& evaluations, int index)
      : evaluations_(evaluations), index_(index) {
    set_num_residuals(evaluations.RowCount(index));
    mutable_parameter_block_sizes()->push_back(shared_count);
    if (own_count > 0) mutable_parameter_block_sizes()->push_back(own_count);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    // Not even a free flight leads on from there: a rejected step; the evaluations keep the reason.
    if (!evaluations_.IsEvaluated(index_)) return false;
    const bool has_own = parameter_block_sizes().size() > 1;
    evaluations_.Copy(index_, residuals, jacobians ? jacobians[0] : nullptr,
                      jacobians && has_own ? jacobians[1] : nullptr);
    return true;
  }

 private:
  const TrialEvaluations& evaluations_;
  int index_;
};

// Keeps a search on an edge: how far the values have left it, made as dear as a hundred times what
// the residuals move by.
class EdgeCost : public ceres::CostFunction {
 public:
  // Where the search is now lies on the edge.
  EdgeCost(const Edge& edge, int shared_count, const double* shared, const double* own)
      : edge_(edge), shared_count_(shared_count) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(shared_count);
    const int own_count = static_cast<int>(edge.normal.size()) - shared_count;
    if (own_count > 0) mutable_parameter_block_sizes()->push_back(own_count);
    place_ = Along(shared, own);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    constexpr double kDear = 100.0;
    const double weight = kDear * edge_.slope;
    const bool has_own = parameter_block_sizes().size() > 1;
    residuals[0] = weight * (Along(blocks[0], has_own ? blocks[1] : nullptr) - place_);
    if (!jacobians) return true;
    for (int b = 0, begin = 0; b < (has_own ? 2 : 1); begin = shared_count_, ++b) {
      if (!jacobians[b]) continue;
      for (int k = 0; k < parameter_block_sizes()[static_cast<std::size_t>(b)]; ++k)
        jacobians[b][k] = weight * edge_.normal[begin + k];
    }
    return true;
  }

 private:
  double Along(const double* shared, const double* own) const {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < edge_.normal.size(); ++k)
      sum += edge_.normal[k] * (k < shared_count_ ? shared[k] : own[k - shared_count_]);
    return sum;
  }

  const Edge& edge_;
  int shared_count_;
  double place_ = 0.0;
};

class Watch : public ceres::IterationCallback {
 public:
  Watch(const SolveRequest& request, const TrialEvaluations& evaluations,
        const RunSettings& settings)
      : request_(request), evaluations_(evaluations), settings_(settings) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (request_.progress) request_.progress(summary.iteration, summary.cost);
    if (request_.stop && *request_.stop) return ceres::SOLVER_ABORT;
    // A step not taken has the cost of where it would have led.
    costs_.push_back(costs_.empty() ? summary.cost : std::fmin(costs_.back(), summary.cost));
    if (summary.step_is_successful)
      met_bound_ = MeetsBound();
    else if (summary.step_is_valid)  // else no point was tried
      beyond_ = TriedBeyond();
    if (met_bound_ || !beyond_.empty()) return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    converged_ = summary.step_is_successful && IsAtMinimum(summary.cost);
    if (converged_) return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    return IsHopeless() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  /// The search ended at a minimum.
  bool converged() const { return converged_; }
  /// It ended since a value that was free came to a bound.
  bool met_bound() const { return met_bound_; }
  /// It ended since a step was not taken that led beyond the bounds of these free values.
  const Places& beyond() const { return beyond_; }

 private:
  // Ceres asks what the next step has gained, and then drops it; here it is not taken.
  bool IsAtMinimum(double cost) const {
    return evaluations_.PredictedGain(settings_.held) <= request_.function_tolerance * cost;
  }
  bool MeetsBound() const {
    if (request_.hold_shared) return false;
    const Places out = PushedOut(request_, evaluations_);
    return std::any_of(out.begin(), out.end(), [&](int k) { return !Contains(settings_.held, k); });
  }
  // Ceres ends a step on the bounds it would cross, the other values moved as if it had not.
  Places TriedBeyond() const {
    Places beyond;
    if (request_.hold_shared) return beyond;
    const Eigen::VectorXd tried = evaluations_.TriedShared();
    for (int k = 0; k < tried.size(); ++k) {
      const SharedParameter& s = request_.problem->shared[static_cast<std::size_t>(k)];
      if ((IsOnLower(s, tried[k]) || IsOnUpper(s, tried[k])) && !Contains(settings_.held, k) &&
          !Contains(settings_.not_to_bound, k))
        beyond.push_back(k);
    }
    return beyond;
  }
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
  const TrialEvaluations& evaluations_;
  const RunSettings& settings_;
  bool converged_ = false, met_bound_ = false;
  Places beyond_;
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

// The values where the evaluations are.
void Take(const SolveRequest& request, TrialEvaluations& evaluations, SolveResult& result) {
  evaluations.PrepareForEvaluation(false, false);
  result.complete = evaluations.IsComplete();
  result.shared = evaluations.SharedValues();
  result.initial_states.clear();
  for (std::size_t i = 0; i < request.trials->size(); ++i)
    result.initial_states.push_back(evaluations.OwnValuesOf(static_cast<int>(i)));
}

// Keeps what acts in a trial within its bounds, the shared values where they are. They may move on:
// then the trial's value is cut (ActingShared), and the next run has other bounds.
void BoundDeviations(const SolveRequest& request, TrialEvaluations& evaluations, int index,
                     ceres::Problem& to) {
  const TrialProblem& trial = (*request.trials)[static_cast<std::size_t>(index)];
  const OwnValues& start = request.initial_states[static_cast<std::size_t>(index)];
  double* own = evaluations.own(index);
  for (int k = 0; k < trial.own_count(); ++k) {
    const OwnParameter& o = trial.own[static_cast<std::size_t>(k)];
    if (o.deviation_of < 0) continue;
    const auto [low, high] = OwnBounds(*request.problem, o, evaluations.SharedValues());
    own[k] = std::clamp(own[k], (low - start[k]) / o.scale, (high - start[k]) / o.scale);
    to.SetParameterLowerBound(own, k, (low - start[k]) / o.scale);
    to.SetParameterUpperBound(own, k, (high - start[k]) / o.scale);
  }
}

// The unknowns, their bounds, which of them are held, and the edges they stay on.
void Describe(const SolveRequest& request, const RunSettings& settings,
              TrialEvaluations& evaluations, ceres::Problem& to,
              ceres::ParameterBlockOrdering& ordering) {
  const FitProblem& problem = *request.problem;
  const std::vector<TrialProblem>& trials = *request.trials;
  // Own values belong to one trial each: Ceres eliminates them trial by trial, so that the cost of
  // a step grows with the number of trials and no faster.
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const int index = static_cast<int>(i), own_count = trials[i].own_count();
    std::vector<double*> blocks = {evaluations.shared()};
    if (own_count > 0) blocks.push_back(evaluations.own(index));
    to.AddResidualBlock(new TrialCost(problem.shared_count(), own_count, evaluations, index),
                        nullptr, blocks);
    if (own_count == 0) continue;
    ordering.AddElementToGroup(evaluations.own(index), 0);
    std::vector<int> held_own;
    for (int k = 0; k < own_count; ++k) {
      if (request.hold_initial_states || !trials[i].own[static_cast<std::size_t>(k)].free)
        held_own.push_back(k);
    }
    HoldComponents(to, evaluations.own(index), own_count, held_own);
    BoundDeviations(request, evaluations, index, to);
  }
  ordering.AddElementToGroup(evaluations.shared(), 1);
  for (const Edge& edge : settings.edges) {
    double* own = evaluations.own(edge.trial);
    std::vector<double*> blocks = {evaluations.shared()};
    if (edge.normal.size() > problem.shared_count()) blocks.push_back(own);
    to.AddResidualBlock(new EdgeCost(edge, problem.shared_count(), evaluations.shared(), own),
                        nullptr, blocks);
  }
  HoldComponents(to, evaluations.shared(), problem.shared_count(), settings.held);
  if (request.hold_shared) return;
  for (int k = 0; k < problem.shared_count(); ++k) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
    to.SetParameterLowerBound(evaluations.shared(), k, s.lower / s.scale);
    to.SetParameterUpperBound(evaluations.shared(), k, s.upper / s.scale);
  }
}

}  // namespace

CeresRun RunCeres(const SolveRequest& request, const RunSettings& settings,
                  TrialEvaluations& evaluations) {
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &evaluations;
  ceres::Problem problem(problem_options);
  auto* ordering = new ceres::ParameterBlockOrdering;
  Describe(request, settings, evaluations, problem, *ordering);

  ceres::Solver::Options options;
  const bool eliminates = !request.hold_shared && !request.hold_initial_states;
  options.linear_solver_type = eliminates ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
  options.linear_solver_ordering.reset(ordering);
  options.max_num_iterations = settings.max_iterations;
  options.function_tolerance = request.function_tolerance;
  options.parameter_tolerance = 1e-11;
  options.gradient_tolerance = 1e-12;
  // Beyond a fall the cost jumps where the sequence of events changes: such a step only shrinks the
  // region.
  options.max_num_consecutive_invalid_steps = 60;
  // A step beyond a bound ends on it, and Solve holds what meets one: no line search along it.
  options.max_num_line_search_step_size_iterations = 0;
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;
  Watch watch(request, evaluations, settings);
  options.callbacks.push_back(&watch);

  // What Ceres logs of a failed step its summary says as well; it is no user's message.
  static const bool silent = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  static_cast<void>(silent);

  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  CeresRun run{.beyond = watch.beyond()};
  SolveResult& result = run.result;
  const bool stopped = watch.met_bound() || !run.beyond.empty();
  result.status = watch.converged() ? SolveStatus::kConverged
                  : stopped         ? SolveStatus::kIterationLimit
                                    : StatusOf(summary);
  result.iterations = static_cast<int>(summary.iterations.size()) - 1;  // the first only looks
  if (result.status == SolveStatus::kFailed) result.message = summary.message;
  Take(request, evaluations, result);
  // What is held fixed counts in it, what keeps the search on edges does not.
  result.cost = settings.edges.empty() ? summary.final_cost : evaluations.Cost();
  return run;
}

}  // namespace hoplab
