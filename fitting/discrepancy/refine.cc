#include "fitting/discrepancy/refine.h"

#include <cmath>

namespace hoplab {
namespace {

constexpr int kRounds = 5;
// Rounds that raise the restricted likelihood by less than this have settled [nats].
constexpr double kSettled = 0.1;

SolveResult SolveUnder(const FitProblem& problem, const RefineRequest& request,
                       const SolveResult& from) {
  SolveRequest solve;
  solve.problem = &problem;
  solve.trials = request.trials;
  solve.shared = from.shared;
  solve.starts = from.starts;
  solve.held = request.held;
  solve.loss = request.loss;
  solve.max_iterations = request.max_iterations;
  solve.function_tolerance = request.function_tolerance;
  solve.jobs = request.jobs;
  solve.stop = request.stop;
  return Solve(solve);
}

}  // namespace

RefinedFit Refine(FitProblem& problem, const RefineRequest& request) {
  RefinedFit out;
  out.at.shared = request.shared;
  out.at.starts = request.starts;
  out.at.status = SolveStatus::kNoStart;
  double before = -std::numeric_limits<double>::infinity();
  bool near = request.noise_is_near;
  for (int round = 0; round < kRounds; ++round) {
    const RestrictedLikelihood likelihood(problem, *request.trials, out.at.shared, out.at.starts,
                                          request.jobs, LikelihoodDetail::Coarse());
    const DiscrepancyEstimate found = EstimateDiscrepancy(likelihood, problem.noise, near);
    const bool stays_white = found.noise.IsWhite() && problem.noise.IsWhite();
    out.discrepancy = found;
    const bool settled = std::abs(found.log_likelihood - before) < kSettled;
    if (settled || (stays_white && out.at.status != SolveStatus::kNoStart)) break;
    before = found.log_likelihood;
    problem.noise = found.noise;
    near = true;
    SolveResult next = SolveUnder(problem, request, out.at);
    if (!IsUsable(next.status)) break;
    out.at = std::move(next);
    if (stays_white || (request.stop && *request.stop)) break;
  }
  return out;
}

}  // namespace hoplab
