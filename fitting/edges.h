#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "fitting/problem.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

/// A surface among the values of a fit on which the derivatives of a trial's residuals jump: on one
/// side a foot lands and slides, on the other it lands and holds. The residuals do not jump, so a
/// minimum may lie on it: the linear model of either side then promises a step that crosses it, and
/// beyond it the step loses.
struct Edge {
  int trial = 0;
  Eigen::VectorXd normal;  // over [shared values, the trial's own], each over its scale; length 1
  /// How much the residuals of all trials move along the normal, to first order.
  double slope = 0.0;
};

/// A point of a least-squares problem, and what of it stays where it is.
struct EdgePoint {
  const FitProblem& problem;
  const std::vector<TrialProblem>& trials;
  const Eigen::VectorXd& shared;      // own units
  const std::vector<OwnValues>& own;  // one set a trial
  std::vector<int> held;              // shared values
  bool hold_own = false;
  Loss loss = {};
  int jobs = 1;
};

/// What a Gauss-Newton step from a point promises that stays on the edges through it.
struct EdgeCheck {
  std::vector<Edge> edges;
  double promised_nats = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd promised_step;  // of the shared values, own units
};

/// Looks for edges through a point: where the derivatives on the two ends of a short way along the
/// Gauss-Newton step differ by more than a smooth function's do. No edge where a simulation ends
/// early.
EdgeCheck CheckEdges(const EdgePoint& at);

}  // namespace hoplab
