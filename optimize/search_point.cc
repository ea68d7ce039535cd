#include "optimize/search_point.h"

#include <algorithm>
#include <cmath>

#include "base/nan.h"
#include "model/mechanism_traits.h"
#include "optimize/stride_map.h"
#include "optimize/stride_search.h"

namespace hoplab {
namespace {

// By how much the constraints are broken, relative to their size; names the worst.
double Violation(const SearchProblem& problem, SearchPoint& point) {
  double sum = 0.0, worst = 0.0;
  const auto add = [&](const char* name, double excess, double size) {
    if (!(excess > 0.0)) return;
    const double relative = excess / std::max(std::abs(size), 1e-9);
    sum += relative;
    if (relative > worst) {
      worst = relative;
      point.violated = name;
    }
  };
  const SearchConstraints& c = problem.constraints;
  if (c.min_speed) add("min_speed", *c.min_speed - point.speed, *c.min_speed);
  if (c.max_torque) add("max_torque", point.torque - *c.max_torque, *c.max_torque);
  if (c.min_clearance) add("min_clearance", *c.min_clearance - point.clearance, *c.min_clearance);
  if (c.max_deflection_ratio)
    add("max_flexure", point.deflection_ratio - *c.max_deflection_ratio, *c.max_deflection_ratio);
  return sum;
}

// Rows to sample the torque on: T is linear in vx, which is smooth in stance; 2 ms are a fiftieth
// of the shortest stance.
std::vector<double> TorqueRows(double horizon) {
  constexpr double kStep = 0.002;
  std::vector<double> rows;
  for (int i = 0; i * kStep <= horizon; ++i) rows.push_back(i * kStep);
  return rows;
}

void Measure(const Hopper& hopper, const Trajectory& run, SearchPoint& point) {
  point.deflection_ratio = run.max_deflection_ratio;
  point.outcome = run.outcome;
  const double touchdown = TouchdownHeightOf(hopper);
  point.clearance = kNaN;
  for (const Event& event : run.events) {
    if (event.kind == EventKind::kApex)
      point.clearance = std::fmin(point.clearance, event.y - touchdown);
  }
  if (run.samples.empty()) return;
  point.torque = 0.0;
  for (const double torque : run.samples) {
    if (std::isfinite(torque)) point.torque = std::max(point.torque, std::abs(torque));
  }
}

Trajectory Run(const SearchProblem& problem, SimulationRequest request) {
  const std::array channels = {Channel::kHipTorque};
  std::vector<double> rows;
  if (problem.constraints.max_torque) {
    rows = TorqueRows(request.horizon);
    request.row_times = rows;
    request.channels = channels;
  }
  return Simulate(request);
}

void ScoreRadius(const SearchProblem& problem, const Hopper& hopper, SearchPoint& point) {
  const FixedPoint steady = SteadyHop(hopper);
  point.outcome = steady.hop.outcome;
  if (!steady.found()) {
    // A hop that can be made but leads nowhere steady is nearer to a gait than one that cannot.
    SetVerdict(point, steady.hop.ok() ? PointVerdict::kNoConvergence : PointVerdict::kRunEnded,
               1.0);
    return;
  }
  point.spectral_radius = steady.spectral_radius;
  point.speed = steady.state[0];
  SimulationRequest hop = RequestOf(hopper);
  hop.parameters.start_angle = kNaN;  // the leg is placed, as after every hop
  hop.initial = {0.0, steady.state[1], steady.state[0], 0.0};
  hop.horizon = steady.hop.period;
  hop.max_hops = 1;
  Measure(hopper, Run(problem, hop), point);
  if (!steady.stable()) {
    SetVerdict(point, PointVerdict::kNoConvergence, Squash(point.spectral_radius - 1.0));
    return;
  }
  if (const double broken = Violation(problem, point); broken > 0.0) {
    SetVerdict(point, PointVerdict::kConstraint, Squash(broken));
    return;
  }
  point.objective = point.spectral_radius;
  SetVerdict(point, PointVerdict::kGood, point.spectral_radius);
}

void ScoreTime(const SearchProblem& problem, const Hopper& hopper, SearchPoint& point) {
  const Trajectory run = Run(problem, RequestOf(hopper));
  Measure(hopper, run, point);
  if (!IsComplete(run.outcome)) {
    SetVerdict(point, PointVerdict::kRunEnded, 1.0 - run.end_time / hopper.request.horizon);
    return;
  }
  const std::vector<ApexSpeed> apexes = ApexSpeeds(run);
  point.convergence = ConvergenceTimeOf(apexes);
  point.speed = point.convergence.steady_speed;
  if (!point.convergence.converged()) {
    SetVerdict(point, PointVerdict::kNoConvergence, Squash(point.convergence.spread));
    return;
  }
  if (const double broken = Violation(problem, point); broken > 0.0) {
    SetVerdict(point, PointVerdict::kConstraint, Squash(broken));
    return;
  }
  const bool wide = point.convergence.band == ConvergenceTime::Band::kTwoPercent;
  const double share = point.convergence.time / run.end_time;
  point.objective = point.convergence.time;
  double within = share;
  if (problem.objective == SearchObjective::kWeighted) {
    const double y = run.events.empty() ? hopper.request.initial[1] : [&] {
      for (std::size_t i = run.events.size(); i-- > 0;)
        if (run.events[i].kind == EventKind::kApex) return run.events[i].y;
      return hopper.request.initial[1];
    }();
    const FixedPoint steady = SteadyHop(hopper, ApexState(apexes.back().vx, y));
    point.spectral_radius = steady.spectral_radius;
    if (!steady.stable()) {
      SetVerdict(point, PointVerdict::kNoConvergence, Squash(steady.spectral_radius - 1.0));
      point.objective = kNaN;
      return;
    }
    within = (1.0 - problem.weight) * share + problem.weight * steady.spectral_radius;
    point.objective = within;
  }
  SetVerdict(point, wide ? PointVerdict::kWideBand : PointVerdict::kGood, within);
}

}  // namespace

double Squash(double x) { return std::isfinite(x) ? x / (1.0 + x) : 1.0; }

void SetVerdict(SearchPoint& point, PointVerdict verdict, double within) {
  point.verdict = verdict;
  point.score = static_cast<int>(verdict) + std::clamp(within, 0.0, 1.0);
}

bool IsOfStrides(SearchObjective objective) {
  return objective != SearchObjective::kConvergenceTime && objective != SearchObjective::kWeighted;
}

bool IsOfHops(SearchObjective objective) {
  return !IsOfStrides(objective) || objective == SearchObjective::kSpectralRadius;
}

std::string_view NameOf(PointVerdict verdict) {
  switch (verdict) {
    case PointVerdict::kGood:
      return "good";
    case PointVerdict::kWideBand:
      return "wide_band";
    case PointVerdict::kConstraint:
      return "constraint";
    case PointVerdict::kNoConvergence:
      return "no_convergence";
    case PointVerdict::kRunEnded:
      return "run_ended";
  }
  return "";
}

double TouchdownHeightOf(const Hopper& hopper) {
  const auto height = TraitsOf(hopper.request.law).touchdown_height;
  return height ? height(hopper.request.parameters) : kNaN;
}

FixedPoint SteadyHop(const Hopper& hopper, const std::optional<ApexState>& near) {
  if (TraitsOf(hopper.request.law).lands_leg_by_leg)
    return HasStrides(hopper) ? FindSteadyStride(hopper).point : FixedPoint();
  ApexMap map(hopper);
  const auto& s = hopper.request.initial;
  const ApexState start(s[2], s[1] + s[3] * s[3] / (2.0 * hopper.request.parameters.g));
  return SearchFixedPoint(map, near.value_or(start), {.tolerance = 1e-8});
}

SearchPoint EvaluatePoint(const SearchProblem& problem, std::span<const double> x) {
  SearchPoint point;
  point.x.assign(x.begin(), x.end());
  const Hopper hopper = problem.hopper_at(x);
  if (HasStrides(hopper))
    ScoreStride(problem, hopper, point);
  else if (problem.objective == SearchObjective::kSpectralRadius)
    ScoreRadius(problem, hopper, point);
  else
    ScoreTime(problem, hopper, point);
  return point;
}

}  // namespace hoplab
