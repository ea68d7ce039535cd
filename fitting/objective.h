#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "fitting/problem.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

/// The least-squares objective of trials at one point: what a fit makes small, with its exact
/// derivatives, for whoever searches or samples by other means. Columns are the shared values, then
/// the own values (x, y [m], vx, vy [m/s] of the start first) of one trial after the other, all in
/// their own units; held ones have columns, too.
struct Objective {
  /// Every trial was simulated to the end of its data. If not, numbers are NaN and the rest empty.
  bool complete = false;
  double cost = std::numeric_limits<double>::quiet_NaN();  // half the sum of squared residuals
  Eigen::VectorXd residuals;      // whitened, trial by trial, as in TrialEvaluation
  Eigen::MatrixXd jacobian;       // d residuals / d columns
  Eigen::VectorXd gradient;       // d cost / d columns: the Jacobian's transpose on the residuals
  std::vector<Outcome> outcomes;  // one a trial
};

/// The objective of `trials` (of `problem`) at shared values and own values, one set a trial. The
/// result does not depend on `jobs`. Residuals and Jacobian, which grow with the square of the
/// number of trials, are left empty unless `matrices` asks for them.
Objective EvaluateObjective(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                            const Eigen::VectorXd& shared,
                            const std::vector<OwnValues>& initial_states, const Loss& loss = {},
                            int jobs = 1, bool matrices = true);

}  // namespace hoplab
