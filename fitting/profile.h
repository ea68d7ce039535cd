#pragma once

#include <optional>
#include <vector>

#include "fitting/fit.h"

namespace hoplab {

/// One point of a profile: the value held, and what the rest could make of it.
struct ProfilePoint {
  double value;       // own unit
  double delta_chi2;  // 2 (cost - cost of the fit); NaN if the search failed there
  Eigen::VectorXd shared;
};

/// Profile likelihood of one shared value.
struct Profile {
  int parameter;
  std::vector<ProfilePoint> points;  // ascending value
  /// Where delta_chi2 crosses 3.84, by interpolation; absent where it never does.
  std::optional<double> lower95, upper95;
};

/// Walks away from the optimum in both directions, the other values and the starts refitted at each
/// point, until delta_chi2 exceeds 2 x 3.84, a bound is met or `max_points` are used on a side.
/// `first_step` [own unit] is adapted on the way.
Profile ComputeProfile(const FitProblem& problem, const FitResult& fit, const FitOptions& options,
                       int parameter, double first_step, int max_points = 12);

}  // namespace hoplab
