#include "fitting/solve.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fitting/deviation.h"
#include "fitting/trial_evaluations.h"
#include "fitting/values_on_bounds.h"

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

// What a run of Ceres moves, and for how long.
struct RunSettings {
  Places held;
  Places not_to_bound;  // values that were tried on their bound in vain
  int max_iterations = 0;
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

std::vector<int> AllShared(const FitProblem& problem) {
  std::vector<int> all(static_cast<std::size_t>(problem.shared_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
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

// Whether a search can begin where the evaluations are; where not, `result` says why.
bool CanBegin(const SolveRequest& request, TrialEvaluations& evaluations, SolveResult& result) {
  evaluations.PrepareForEvaluation(true, false);
  result.status = SolveStatus::kNoStart;
  for (int i = 0; i < static_cast<int>(request.trials->size()); ++i) {
    if (evaluations.IsEvaluated(i)) continue;
    result.message = evaluations.ReasonOf(i);
    return false;
  }
  if (evaluations.Cost() > request.start_below) {
    result.message = "the search would begin too far away";
    return false;
  }
  evaluations.ForgetRejected();
  return true;
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

// The unknowns, their bounds, and which of them are held.
void Describe(const SolveRequest& request, const Places& held, TrialEvaluations& evaluations,
              ceres::Problem& to, ceres::ParameterBlockOrdering& ordering) {
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
  HoldComponents(to, evaluations.shared(), problem.shared_count(), held);
  if (request.hold_shared) return;
  for (int k = 0; k < problem.shared_count(); ++k) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
    to.SetParameterLowerBound(evaluations.shared(), k, s.lower / s.scale);
    to.SetParameterUpperBound(evaluations.shared(), k, s.upper / s.scale);
  }
}

// One run of Ceres, from where the evaluations are to where they are then.
struct Run {
  SolveResult result;
  Places beyond;  // as Watch has it
};
Run RunCeres(const SolveRequest& request, const RunSettings& settings,
             TrialEvaluations& evaluations) {
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &evaluations;
  ceres::Problem problem(problem_options);
  auto* ordering = new ceres::ParameterBlockOrdering;
  Describe(request, settings.held, evaluations, problem, *ordering);

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

  Run run{.beyond = watch.beyond()};
  SolveResult& result = run.result;
  const bool stopped = watch.met_bound() || !run.beyond.empty();
  result.status = watch.converged() ? SolveStatus::kConverged
                  : stopped         ? SolveStatus::kIterationLimit
                                    : StatusOf(summary);
  result.cost = summary.final_cost;  // what is held fixed counts in it
  result.iterations = static_cast<int>(summary.iterations.size()) - 1;  // the first only looks
  if (result.status == SolveStatus::kFailed) result.message = summary.message;
  Take(request, evaluations, result);
  return run;
}

}  // namespace

SolveResult Solve(const SolveRequest& request) {
  // At the optimum the costs of two runs differ by rounding.
  constexpr double kSame = 1e-9;
  constexpr int kMaxRounds = 12;
  TrialEvaluations evaluations(request);
  SolveResult best;
  if (!CanBegin(request, evaluations, best)) {
    best.shared = request.shared;
    best.initial_states = request.initial_states;
    return best;
  }
  // A trust region cut by a bound crawls: the step it would take is projected, and what is left of
  // it gains little. So a value that comes to a bound, or would go beyond one, is put and held
  // there while the rest is solved. What the gradient pulls inside at the end of a run is free in
  // the next, until nothing changes.
  RunSettings settings{.held = request.held};
  for (int k = 0; k < request.problem->shared_count(); ++k)
    if (request.problem->shared[static_cast<std::size_t>(k)].held && !Contains(settings.held, k))
      settings.held.push_back(k);
  if (request.hold_shared) settings.held = AllShared(*request.problem);
  Places put;  // on their bounds before this run
  int iterations = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    settings.max_iterations = request.max_iterations - iterations;
    const Run run = RunCeres(request, settings, evaluations);
    const SolveResult& next = run.result;
    iterations += std::max(next.iterations, 1);
    const bool last = iterations >= request.max_iterations || round + 1 == kMaxRounds;
    if (round > 0 && !(IsUsable(next.status) && next.cost <= best.cost * (1.0 + kSame))) {
      if (put.empty() || last || next.status == SolveStatus::kInterrupted) break;
      settings.not_to_bound.insert(settings.not_to_bound.end(), put.begin(), put.end());
      std::erase_if(settings.held, [&](int k) { return Contains(put, k); });
      put.clear();
      evaluations.MoveTo(best.shared, best.initial_states);
      continue;
    }
    const bool gained = round == 0 || next.cost < best.cost * (1.0 - kSame);
    best = next;
    if (request.hold_shared || !IsUsable(best.status) || best.status == SolveStatus::kGaveUp) break;
    Places held = request.held;
    for (const Places& more : {PushedOut(request, evaluations), run.beyond})
      held.insert(held.end(), more.begin(), more.end());
    if (held == settings.held || (!gained && best.status == SolveStatus::kConverged)) break;
    if (last) {
      best.status = SolveStatus::kIterationLimit;
      break;
    }
    settings.held = held;
    put = run.beyond;
    evaluations.TakeTried(put);
  }
  best.iterations = iterations;
  best.rejected = evaluations.rejected();
  return best;
}

}  // namespace hoplab
