#include "fitting/growing_horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "fitting/trial_evaluator.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

// Most iterations of a round that is not the last.
constexpr int kIterations = 30;
// Relative change of the cost that ends such a round of a robot: the next one moves on from there.
// (A hopper's traces seldom need to grow.)
constexpr double kRobotRound = 1e-5;

// Nats by which a round's cost is clearly above another's.
constexpr double kBehind = 10.0;

// What the first rows cannot tell yet, the stiffness of a leg in the air, must not run off to where
// later rows let no search begin: in a round each shared value is known to this share of itself, at
// least of its typical size, about where the round begins. The last round knows nothing.
constexpr double kRoomOfARound = 0.5;

// The first `known` of the trials was fitted before: rounds are small beyond, since a gait
// magnifies the errors of what was found.
constexpr double kBeyond = 1.2, kLastRound = 0.9;

// Shares of the trials' time of all rounds but the last.
std::vector<double> RoundsFrom(double known) {
  if (known == 0.0) return {0.12, 0.2, 0.3, 0.45, 0.65, 0.85};
  std::vector<double> shares;
  for (double share = kBeyond * known; share < kLastRound; share *= kBeyond)
    shares.push_back(share);
  return shares;
}

bool IsBehind(double cost, double other) { return std::isfinite(cost) && cost > other + kBehind; }

// Costs of two rounds that ended at one minimum, as near as a round goes: by this share, and by a
// nat at most. Where either came to nothing they are not alike.
constexpr double kAlike = 1e-3;
bool IsAlike(double cost, double other) {
  return std::isfinite(cost) && std::isfinite(other) &&
         std::abs(cost - other) <= std::min(kAlike * (1.0 + other), 1.0);
}

// The trials cut to the first `fraction` of their time, and what a round that begins at `shared`
// knows.
std::vector<TrialProblem> CutToFraction(const FitProblem& problem,
                                        const std::vector<TrialProblem>& trials,
                                        const Eigen::VectorXd& shared, double fraction) {
  std::vector<TrialProblem> cut;
  for (const TrialProblem& trial : trials)
    cut.push_back(FirstPart(problem, trial, fraction * trial.row_times.back()));
  for (int k = 0; k < problem.shared_count(); ++k) {
    const double size =
        std::max(problem.shared[static_cast<std::size_t>(k)].scale, std::abs(shared[k]));
    cut.front().shared_priors.push_back({k, shared[k], kRoomOfARound * size});
  }
  return cut;
}

SolveResult GivenUp(SolveResult result) {
  result.status = SolveStatus::kGaveUp;
  result.cost = std::numeric_limits<double>::infinity();
  result.complete = false;
  return result;
}

SolveResult Grow(SolveRequest request, double known_until, const RoundCosts& other,
                 RoundCosts& costs, bool only_elsewhere = false) {
  const SolveRequest at_once = request;
  bool moved = false;
  const std::vector<TrialProblem>& whole = *request.trials;
  for (const double fraction : RoundsFrom(known_until / LongestTrial(whole))) {
    const std::vector<TrialProblem> cut =
        CutToFraction(*request.problem, whole, request.shared, fraction);
    request.trials = &cut;
    // Beyond what is known a round ends at its minimum: what it leaves the next one magnifies.
    if (known_until == 0.0) request.max_iterations = kIterations;
    if (known_until == 0.0 && TraitsOf(request.problem->law).has_costly_runs)
      request.function_tolerance = std::max(at_once.function_tolerance, kRobotRound);
    SolveResult next = Solve(request);
    if (next.status == SolveStatus::kInterrupted) return next;
    costs.push_back(IsUsable(next.status) ? next.cost : std::numeric_limits<double>::infinity());
    const std::size_t round = costs.size() - 1;
    if (round < other.size() && (IsBehind(costs.back(), other[round]) ||
                                 (only_elsewhere && IsAlike(costs.back(), other[round]))))
      return GivenUp(std::move(next));
    if (!IsUsable(next.status)) continue;
    moved = true;
    request.shared = std::move(next.shared);
    request.initial_states = std::move(next.initial_states);
  }
  request.trials = &whole;
  request.max_iterations = at_once.max_iterations;
  request.function_tolerance = at_once.function_tolerance;
  SolveResult grown = Solve(request);
  if (!moved || IsUsable(grown.status) || grown.status == SolveStatus::kInterrupted) return grown;
  // The rounds led to where no simulation follows all rows. The values they began with may.
  SolveResult anew = Solve(at_once);
  return IsUsable(anew.status) || anew.status == SolveStatus::kInterrupted ? anew : grown;
}

}  // namespace

SolveResult GrowHorizon(SolveRequest request, double known_until) {
  RoundCosts costs;
  return Grow(std::move(request), known_until, {}, costs);
}

SolveResult GrowHorizonBeside(SolveRequest request, const RoundCosts& other, RoundCosts& costs) {
  return Grow(std::move(request), 0.0, other, costs);
}

SolveResult GrowHorizonElsewhere(SolveRequest request, const RoundCosts& other) {
  RoundCosts costs;
  return Grow(std::move(request), 0.0, other, costs, /*only_elsewhere=*/true);
}

}  // namespace hoplab
