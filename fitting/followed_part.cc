#include "fitting/followed_part.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "fitting/trial_evaluator.h"
#include "model/robot_parameters.h"

namespace hoplab {
namespace {

// What of a flight follows the first stances, as a share of the time until then.
constexpr double kAfterStances = 1.1;

// When every leg has landed and left again; absent where the simulation ends before.
std::optional<double> StancesOver(const Trajectory& trajectory, int legs) {
  std::array<bool, kMaxLegs> landed{}, left{};
  for (const Event& e : trajectory.events) {
    const auto leg = static_cast<std::size_t>(e.leg);
    landed[leg] = landed[leg] || e.kind == EventKind::kTouchdown;
    left[leg] = left[leg] || (landed[leg] && e.kind == EventKind::kLiftoff);
    if (std::count(left.begin(), left.end(), true) == legs) return e.time;
  }
  return std::nullopt;
}

}  // namespace

FitProblem FirstPart(const FitProblem& problem, double until) {
  FitProblem part = problem;
  for (TrialProblem& trial : part.trials) trial = FirstPart(problem, trial, until);
  return part;
}

std::optional<double> FirstStancesOver(const FitProblem& problem) {
  std::optional<double> over;
  std::vector<double> landings;
  for (const TrialProblem& trial : problem.trials) {
    TrialEvaluation e;
    TrialEvaluator(problem, trial).Evaluate({InitialShared(problem), trial.start, false}, e);
    const auto stood = StancesOver(e.trajectory, trial.parameters.robot->legs);
    if (stood) over = std::max(over.value_or(0.0), *stood);
    for (const Event& event : e.trajectory.events)
      if (event.kind == EventKind::kTouchdown) landings.push_back(event.time);
  }
  if (!over) return over;
  double until = kAfterStances * *over;
  for (const double landing : landings)
    if (landing > *over) until = std::min(until, 0.5 * (*over + landing));
  return until;
}

double LeastPart(const FitProblem& problem) {
  double latest = 0.0;
  for (const TrialProblem& trial : problem.trials) {
    TrialEvaluation e;
    TrialEvaluator(problem, trial).Evaluate({InitialShared(problem), trial.start, false}, e);
    const auto first =
        std::find_if(e.trajectory.events.begin(), e.trajectory.events.end(),
                     [](const Event& event) { return event.kind == EventKind::kTouchdown; });
    if (first != e.trajectory.events.end()) latest = std::max(latest, first->time);
  }
  return kAfterStances * latest;
}

Parts::Parts(const FitProblem& problem)
    : least_(LeastPart(problem)), end_(LongestTrial(problem.trials)) {
  until_ = FirstStancesOver(problem).value_or(end_);
}
void Parts::Follows() {
  followed_ = true;
  until_ *= kLonger;
}
void Parts::Fails() {
  end_ = (1.0 - 1e-9) * until_;
  if (followed_ || shorter_ == 0 || until_ / kLonger < least_) return;
  --shorter_;
  until_ /= kLonger;
}

std::optional<FollowedPart> FitFollowedPart(const FitProblem& problem, const FitOptions& options) {
  std::optional<FollowedPart> longest;
  for (Parts parts(problem); parts.IsLeft();) {
    FollowedPart part;
    part.until = parts.until();
    part.problem = FirstPart(problem, part.until);
    part.result = Fit(part.problem, options);
    if (part.result.interrupted) break;
    if (!part.result.ok || !part.result.stop.IsMinimum()) {
      parts.Fails();
      continue;
    }
    longest = std::move(part);
    parts.Follows();
  }
  return longest;
}

}  // namespace hoplab
