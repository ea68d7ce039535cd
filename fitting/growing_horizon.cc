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

bool IsBehind(double cost, const Round& other) {
  return std::isfinite(cost) && cost > other.cost + kBehind;
}

// Costs of two rounds that ended at one minimum, as near as a round goes: by this share, and by a
// nat at most. Where either came to nothing they are not alike.
constexpr double kAlike = 1e-3;
bool IsAlike(double cost, const Round& other, double share) {
  return std::isfinite(cost) && std::isfinite(other.cost) &&
         std::abs(cost - other.cost) <= std::min(share * (1.0 + other.cost), 1.0);
}

// The same place: rounds that begin there end alike.
constexpr double kSameCost = 1e-6, kSameValue = 1e-4;
bool IsSame(const FitProblem& problem, const Round& round, const Round& other) {
  if (!IsAlike(round.cost, other, kSameCost)) return false;
  for (int k = 0; k < problem.shared_count(); ++k) {
    const double size =
        std::max(problem.shared[static_cast<std::size_t>(k)].scale, std::abs(other.shared[k]));
    if (!(std::abs(round.shared[k] - other.shared[k]) <= kSameValue * size)) return false;
  }
  return true;
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

// Another search of the same trials, and what it makes this one give up.
struct Beside {
  const Rounds& other;
  bool where_alike = false;  // and not only where the values are the same
  bool EndsAfter(const FitProblem& problem, const Round& round, std::size_t place) const {
    if (place >= other.size()) return false;
    if (IsBehind(round.cost, other[place])) return true;
    return where_alike ? IsAlike(round.cost, other[place], kAlike)
                       : IsSame(problem, round, other[place]);
  }
};

SolveResult Grow(SolveRequest request, double known_until, const Beside& beside, Rounds& rounds) {
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
    const std::size_t place = rounds.size();
    if (place < beside.other.size()) request.give_up_above = beside.other[place].cost + kBehind;
    SolveResult next = Solve(request);
    if (next.status == SolveStatus::kInterrupted) return next;
    const bool usable = IsUsable(next.status);
    rounds.push_back({usable ? next.cost : std::numeric_limits<double>::infinity(), next.shared});
    if (beside.EndsAfter(*request.problem, rounds.back(), place)) return GivenUp(std::move(next));
    if (!usable) continue;
    moved = true;
    request.shared = std::move(next.shared);
    request.initial_states = std::move(next.initial_states);
  }
  request.trials = &whole;
  request.max_iterations = at_once.max_iterations;
  request.function_tolerance = at_once.function_tolerance;
  request.give_up_above = at_once.give_up_above;
  SolveResult grown = Solve(request);
  if (!moved || IsUsable(grown.status) || grown.status == SolveStatus::kInterrupted) return grown;
  // The rounds led to where no simulation follows all rows. The values they began with may.
  SolveResult anew = Solve(at_once);
  return IsUsable(anew.status) || anew.status == SolveStatus::kInterrupted ? anew : grown;
}

}  // namespace

SolveResult GrowHorizon(SolveRequest request, double known_until) {
  Rounds rounds;
  return Grow(std::move(request), known_until, {{}}, rounds);
}

SolveResult GrowHorizonBeside(SolveRequest request, const Rounds& other, Rounds& rounds) {
  return Grow(std::move(request), 0.0, {other}, rounds);
}

SolveResult GrowHorizonElsewhere(SolveRequest request, const Rounds& other) {
  Rounds rounds;
  return Grow(std::move(request), 0.0, {other, /*where_alike=*/true}, rounds);
}

}  // namespace hoplab
