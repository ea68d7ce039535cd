#include "fitting/solve.h"

#include <algorithm>
#include <numeric>

#include "fitting/ceres_run.h"
#include "fitting/trial_evaluations.h"
#include "fitting/values_on_bounds.h"

namespace hoplab {
namespace {

std::vector<int> AllShared(const FitProblem& problem) {
  std::vector<int> all(static_cast<std::size_t>(problem.shared_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
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

// Shared values that stay where they are at the beginning of a search.
Places HeldAtFirst(const SolveRequest& request) {
  if (request.hold_shared) return AllShared(*request.problem);
  Places held = request.held;
  for (int k = 0; k < request.problem->shared_count(); ++k)
    if (request.problem->shared[static_cast<std::size_t>(k)].held && !Contains(held, k))
      held.push_back(k);
  return held;
}

// A search from where the evaluations are, along edges.
SolveResult Descend(const SolveRequest& request, const std::vector<Edge>& edges, int max_iterations,
                    TrialEvaluations& evaluations) {
  // At the optimum the costs of two runs differ by rounding.
  constexpr double kSame = 1e-9;
  constexpr int kMaxRounds = 12;
  SolveResult best;
  // A trust region cut by a bound crawls: the step it would take is projected, and what is left of
  // it gains little. So a value that comes to a bound, or would go beyond one, is put and held
  // there while the rest is solved. What the gradient pulls inside at the end of a run is free in
  // the next, until nothing changes.
  RunSettings settings{.edges = edges, .held = HeldAtFirst(request)};
  Places put;  // on their bounds before this run
  int iterations = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    settings.max_iterations = max_iterations - iterations;
    const CeresRun run = RunCeres(request, settings, evaluations);
    const SolveResult& next = run.result;
    iterations += std::max(next.iterations, 1);
    const bool last = iterations >= max_iterations || round + 1 == kMaxRounds;
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
  return best;
}

// A search ends where it comes to an edge that the linear models of both sides want to cross. There
// it goes on along the edge, and then leaves it where that pays, until neither gains.
void FollowEdges(const SolveRequest& request, TrialEvaluations& evaluations, SolveResult& best) {
  constexpr int kMostTurns = 5;
  constexpr double kWorthNats = 0.05;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    if (best.status != SolveStatus::kConverged || !best.complete) return;
    evaluations.MoveTo(best.shared, best.initial_states);
    evaluations.PrepareForEvaluation(true, false);
    Places held = HeldAtFirst(request);
    if (!request.hold_shared) {
      for (const int k : PushedOut(request, evaluations))
        if (!Contains(held, k)) held.push_back(k);
    }
    if (evaluations.PredictedGain(held) < kWorthNats) return;
    const EdgeCheck check =
        CheckEdges({*request.problem, *request.trials, best.shared, best.initial_states, held,
                    request.hold_initial_states, request.loss, request.jobs});
    if (check.edges.empty() || check.promised_nats < kWorthNats) return;
    const double before = best.cost;
    for (const std::vector<Edge>& edges : {check.edges, std::vector<Edge>()}) {
      const int left = request.max_iterations - best.iterations;
      if (left <= 0) return;
      evaluations.MoveTo(best.shared, best.initial_states);
      const SolveResult next = Descend(request, edges, left, evaluations);
      if (next.status == SolveStatus::kInterrupted) return;
      const int iterations = best.iterations + next.iterations;
      // One that ends elsewhere than at a minimum is worth it only where it gains.
      const double least = next.status == SolveStatus::kConverged ? 0.0 : kWorthNats;
      if (IsUsable(next.status) && next.complete && best.cost - next.cost > least) best = next;
      best.iterations = iterations;
    }
    if (before - best.cost < kWorthNats) return;
  }
}

}  // namespace

SolveResult Solve(const SolveRequest& request) {
  TrialEvaluations evaluations(request);
  SolveResult best;
  if (!CanBegin(request, evaluations, best)) {
    best.shared = request.shared;
    best.initial_states = request.initial_states;
    return best;
  }
  best = Descend(request, {}, request.max_iterations, evaluations);
  if (request.follow_edges) FollowEdges(request, evaluations, best);
  best.rejected = evaluations.rejected();
  return best;
}

}  // namespace hoplab
