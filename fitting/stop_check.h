#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fitting/problem.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

/// Whether a search has ended at a minimum.
struct StopCheck {
  /// Every simulation reaches the end of its data.
  bool complete = false;
  /// Log-likelihood that the linear model still promises there, bounds respected [nats]; NaN where
  /// not even a free flight leads on. At a minimum it is far below one.
  double promised_nats = std::numeric_limits<double>::quiet_NaN();
  /// The step of the shared values that promises it, in their own units; zero for those it holds.
  Eigen::VectorXd promised_step;
  /// Files of trials on whose edges it lies (fitting/edges.h): the promise is that of a step along
  /// them.
  std::vector<std::string> on_edges_of;
  /// Shared values on a bound where no physics ends: a modulus can be neither 1e3 nor 1e13 Pa.
  std::vector<std::string> at_wall;
  /// What speaks against a minimum, one sentence each.
  std::vector<std::string> faults;

  bool IsMinimum() const { return faults.empty(); }
  /// Nothing else speaks against a minimum than what the linear model promises.
  bool OnlyPromises() const;
  /// The promised step in standard errors of the values, the largest; absent where more than
  /// kShareOfCost of the cost is promised, so that the search ended elsewhere, or where no value
  /// has an error. `std_errors` are those of the shared values, NaN for one that is not determined.
  std::optional<double> PromisedErrors(const Eigen::VectorXd& std_errors, double cost) const;
};

/// A gain below this is the tolerance of two searches [nats].
inline constexpr double kMinimumNats = 0.1;

/// A promised step of fewer standard errors is within what an interval says.
inline constexpr double kOfNoConsequence = 0.3;
/// A search that creeps along an edge promises less than this share of the cost.
inline constexpr double kShareOfCost = 1e-3;

/// Shared values that lie where no physics ends (StopCheck::at_wall).
std::vector<std::string> AtWall(const FitProblem& problem, const Eigen::VectorXd& shared);

/// Linearises `trials` (of `problem`) at the values where a search has ended.
StopCheck CheckStop(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                    const Eigen::VectorXd& shared, const std::vector<OwnValues>& initial_states,
                    const Loss& loss, int jobs);

}  // namespace hoplab
