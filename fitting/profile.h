#pragma once

#include <optional>
#include <vector>

#include "fitting/fit.h"

namespace hoplab {

/// One point of a profile: the value held, and what the rest could make of it.
struct ProfilePoint {
  double value;  // own unit
  /// 2 (cost - cost of the fit) over the value's inflation; NaN if the search failed there.
  double delta_chi2;
  Eigen::VectorXd shared;
};

/// Profile likelihood of one shared value.
struct Profile {
  int parameter;
  std::vector<ProfilePoint> points;  // ascending value
  /// Where delta_chi2 crosses 3.84, by interpolation; absent where it never does.
  std::optional<double> lower95, upper95;
};

/// Walks away from the optimum in both directions, the other values and the initial states refitted
/// at each point, until delta_chi2 exceeds 2 x 3.84, a bound is met or `max_points` are used on a
/// side. `first_step` [own unit] is adapted on the way. `inflation` (ParameterUncertainty) is what
/// a discrepancy makes of the variance of white noise: squares of least squares divided by it are
/// spread as a chi-square (Chandler and Bate 2007).
Profile ComputeProfile(const FitProblem& problem, const FitResult& fit, const FitOptions& options,
                       int parameter, double first_step, double inflation = 1.0,
                       int max_points = 12);

}  // namespace hoplab
