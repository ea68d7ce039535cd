#include "optimize/stride_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/mechanisms/gear.h"
#include "optimize/stride_measures.h"

namespace hoplab {
namespace {

constexpr int kStrides = 20;
// Further from its steady stride than this change from stride to stride Newton seldom finds it.
constexpr double kNear = 0.05;
// Newton's residual while searching: the point that is kept is found again to rounding.
constexpr FixedPointOptions kRough{.tolerance = 1e-7, .max_iterations = 6};

// Strides take some 500 steps of the integrator. Of a wide box every thirtieth run lands where it
// takes a million and ends all the same, which was most of a search's time. Teeth with play are
// stiff at their best.
constexpr long kMostSteps = 2000L * kStrides;

Hopper WithFewSteps(Hopper hopper) {
  const RobotParameters<double>& robot = *hopper.request.parameters.robot;
  for (int leg = 0; leg < robot.legs; ++leg)
    if (Gear<double>::HasPlay(robot, leg)) return hopper;
  long& most = hopper.request.integrator.max_steps;
  most = std::min(most, kMostSteps);
  return hopper;
}

double ChangeOf(const StrideMap& map, const SectionState& from, const SectionState& to) {
  const std::vector<SectionComponent> components = map.Components(from);
  double change = 0.0;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    change = std::max(change, std::abs(to[at] - from[at]) / components[i].size);
  }
  return change;
}

double ChangeAt(StrideStart& start) {
  if (!start.map || start.outcome != Outcome::kCompleted)
    return std::numeric_limits<double>::quiet_NaN();
  const Hop hop = start.map->Apply(start.state);
  return hop.ok() ? ChangeOf(*start.map, start.state, hop.next)
                  : std::numeric_limits<double>::quiet_NaN();
}

// Constraints on shares of a stride are measured by a whole one.
constexpr double kStride = 1.0;

// By how much the constraints are broken, relative to their size; names the worst.
double Violation(const SearchConstraints& constraints, SearchPoint& point) {
  double sum = 0.0, worst = 0.0;
  const auto add = [&](const char* name, double excess, double size) {
    const double relative = excess / std::max(std::abs(size), 1e-9);
    if (!(relative > 0.0)) return;
    sum += relative;
    if (relative <= worst) return;
    worst = relative;
    point.violated = name;
  };
  if (const auto& least = constraints.min_speed) add("min_speed", *least - point.speed, *least);
  if (const auto& most = constraints.max_torque) add("max_torque", point.torque - *most, *most);
  if (const auto& most = constraints.max_legs_apart)
    add("max_legs_apart", point.legs_apart - *most, kStride);
  if (const auto& least = constraints.min_legs_apart)
    add("min_legs_apart", *least - point.legs_apart, kStride);
  if (const auto& least = constraints.min_flight_share)
    add("min_flight_share", *least - point.flight_share, kStride);
  return sum;
}

// The objective in its own unit, and what is made small: in [0, 1].
struct Worth {
  double objective, within;
};
Worth WorthOf(SearchObjective objective, const SearchPoint& point) {
  switch (objective) {
    case SearchObjective::kSpeed:
      return {point.speed, 1.0 - Squash(std::max(point.speed, 0.0))};
    case SearchObjective::kCostOfTransport:
      return {point.cost_of_transport, Squash(point.cost_of_transport)};
    case SearchObjective::kPeakTorque:
      return {point.torque, Squash(point.torque)};
    default:
      return {point.spectral_radius, point.spectral_radius};
  }
}

}  // namespace

StrideEnd EndOfStrides(const Hopper& hopper) {
  constexpr double kSettled = 0.02;
  StrideStart start = StartStrides(hopper, 2 * kStrides);
  return {start.outcome != Outcome::kCompleted, ChangeAt(start) <= kSettled};
}

void ScoreStride(const SearchProblem& problem, const Hopper& at, SearchPoint& point) {
  const Hopper hopper = WithFewSteps(at);
  StrideStart start = StartStrides(hopper, kStrides);
  point.outcome = start.outcome;
  const bool fell = start.outcome != Outcome::kCompleted;
  const double left = 1.0 - start.strides / kStrides;
  if (!start.map) return SetVerdict(point, PointVerdict::kRunEnded, left);
  const double change = ChangeAt(start);
  const FixedPoint steady = FindFixedPoint(*start.map, start.state, kRough);
  if (!steady.found())
    return fell ? SetVerdict(point, PointVerdict::kRunEnded, left)
                : SetVerdict(point, PointVerdict::kNoConvergence, 0.5 + 0.5 * Squash(change));
  const StrideMeasures stride = MeasureStride(*start.map, steady.state);
  point.spectral_radius = steady.spectral_radius;
  point.speed = stride.speed;
  point.torque = stride.peak_torque;
  point.cost_of_transport = stride.cost_of_transport;
  point.legs_apart = stride.legs_apart;
  point.flight_share = stride.flight_share;
  point.gait = NameOf(stride.kind);
  // A stride that falls, or from which the start leads elsewhere, tells how far it is from a gait.
  if (!steady.stable())
    return SetVerdict(point, PointVerdict::kNoConvergence,
                      0.1 + 0.4 * Squash(point.spectral_radius - 1.0));
  if (fell || !(change <= kNear || EndOfStrides(hopper).settled))
    return SetVerdict(point, PointVerdict::kNoConvergence, 0.1 * std::max(left, 0.0));
  if (const double broken = Violation(problem.constraints, point); broken > 0.0)
    return SetVerdict(point, PointVerdict::kConstraint, Squash(broken));
  const Worth worth = WorthOf(problem.objective, point);
  point.objective = worth.objective;
  SetVerdict(point, PointVerdict::kGood, worth.within);
}

}  // namespace hoplab
