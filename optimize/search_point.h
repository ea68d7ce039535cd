#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/search_objective.h"
#include "optimize/apex_map.h"
#include "optimize/convergence_time.h"
#include "optimize/fixed_point.h"

namespace hoplab {

/// Whether it is asked of a robot's strides, or of a hopper's hops; the spectral radius is of both.
bool IsOfStrides(SearchObjective objective);
bool IsOfHops(SearchObjective objective);

/// A quantity that is searched over, in the unit of its name.
struct SearchVariable {
  std::string name;
  double low = 0.0, high = 1.0;
};

/// Bounds on a run; absent: none. Speeds and forces over the whole run, or over the steady hop
/// where the objective is the spectral radius.
struct SearchConstraints {
  std::optional<double> min_speed;      // of the steady vx [m/s]
  std::optional<double> max_torque;     // largest |T| [N m]
  std::optional<double> min_clearance;  // least apex height above touch-down height [m]
  // Of a robot's stride (StrideMeasures), in shares of it.
  std::optional<double> max_legs_apart, min_legs_apart, min_flight_share;
  std::optional<double> max_deflection_ratio =
      kMaxDeflectionRatio;  // F C/l0, `large_deflection` only
};

/// What is searched. `hopper_at` is called from several threads.
struct SearchProblem {
  std::vector<SearchVariable> variables;
  std::function<Hopper(std::span<const double> x)> hopper_at;
  SearchObjective objective = SearchObjective::kConvergenceTime;
  double weight = 0.5;
  SearchConstraints constraints;
};

/// What a point is worth, the best first. A failed simulation is no number but one of these.
enum class PointVerdict {
  kGood,           // converged, within the constraints
  kWideBand,       // converged into the 2 % band only
  kConstraint,     // converged, but breaks a constraint
  kNoConvergence,  // hops to the end without settling, or settles on nothing stable
  kRunEnded        // falls, finds no support, ...: `outcome`
};
std::string_view NameOf(PointVerdict verdict);

/// One evaluated point. What does not apply is NaN or empty.
struct SearchPoint {
  std::vector<double> x;
  PointVerdict verdict = PointVerdict::kRunEnded;
  Outcome outcome = Outcome::kIntegrationFailed;
  std::string violated;  // "max_torque": the constraint broken most
  /// What the search minimises: verdict first (its place in the list above), then a number in
  /// [0, 1] that says how near the point is to the next better verdict.
  double score = std::numeric_limits<double>::infinity();
  /// The objective in its own unit, of kGood and kWideBand points.
  double objective = std::numeric_limits<double>::quiet_NaN();
  ConvergenceTime convergence;
  double spectral_radius = std::numeric_limits<double>::quiet_NaN();
  double speed = std::numeric_limits<double>::quiet_NaN();      // steady [m/s]
  double torque = std::numeric_limits<double>::quiet_NaN();     // largest |T| [N m], if asked for
  double clearance = std::numeric_limits<double>::quiet_NaN();  // [m]
  double deflection_ratio = std::numeric_limits<double>::quiet_NaN();
  double cost_of_transport = std::numeric_limits<double>::quiet_NaN();  // of a robot's stride
  double legs_apart = std::numeric_limits<double>::quiet_NaN();         // in shares of it
  double flight_share = std::numeric_limits<double>::quiet_NaN();       // no leg on the ground
  std::string gait;                                                     // its GaitKind
};

/// [0, inf) to [0, 1), keeping the order; 1 for what is not finite.
double Squash(double x);
/// Sets verdict and score; `within` tells how near the next better verdict is, from 0 to 1.
void SetVerdict(SearchPoint& point, PointVerdict verdict, double within);

SearchPoint EvaluatePoint(const SearchProblem& problem, std::span<const double> x);

/// Fixed point that hopping from the hopper's start leads to, searched from `near` if that is
/// given; of a robot with a clock its steady stride. Not found where there is none.
FixedPoint SteadyHop(const Hopper& hopper, const std::optional<ApexState>& near = std::nullopt);

/// Hip height at touch-down [m] (guards of the equation sheet).
double TouchdownHeightOf(const Hopper& hopper);

}  // namespace hoplab
