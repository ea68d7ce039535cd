#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "fitting/problem.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {

/// One least-squares problem for Ceres: shared values and each trial's own.
struct SolveRequest {
  const FitProblem* problem = nullptr;
  const std::vector<TrialProblem>* trials = nullptr;  // one residual block each
  Eigen::VectorXd shared;                             // where to begin, own units
  std::vector<OwnValues> initial_states;              // own values, one a trial
  bool hold_shared = false;                           // only the initial states move
  bool hold_initial_states = false;                   // only the shared values move
  std::vector<int> held;                              // shared values held one by one
  Loss loss;
  int max_iterations = 100;
  double function_tolerance = 1e-12;  // relative change of the cost that counts as converged
  /// A beginning above this cost is none (`kNoStart`).
  double start_below = std::numeric_limits<double>::infinity();
  /// A search that would not get below this cost at its present pace ends.
  double give_up_above = std::numeric_limits<double>::infinity();
  /// A search that ends on an edge (fitting/edges.h) goes on along it.
  bool follow_edges = false;
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;  // set: end as soon as possible
  std::function<void(int iteration, double cost)> progress = nullptr;
};

enum class SolveStatus {
  kConverged,
  kIterationLimit,  // values are usable but not at an optimum
  kGaveUp,          // the same, since it was not worth going on
  kNoStart,         // nothing can be simulated where the search begins, or it is far off
  kFailed,          // the solver gave up
  kInterrupted      // stopped from outside; values are the best so far
};
std::string_view NameOf(SolveStatus status);
/// Whether a result's values can be used, at an optimum or not.
bool IsUsable(SolveStatus status);

struct SolveResult {
  SolveStatus status = SolveStatus::kFailed;
  std::string message;  // for kNoStart and kFailed: which trial, what happened, when
  Eigen::VectorXd shared;
  std::vector<OwnValues> initial_states;  // own values of the trials
  bool complete = false;                  // every simulation reaches the end of its data
  double cost = 0.0;                      // half the sum of squared residuals
  int iterations = 0;
  /// Points at which a simulation ended before its data: reason -> how often.
  std::map<std::string, int> rejected;
};

/// Levenberg-Marquardt by Ceres with bounds; simulations run in parallel over trials, and the
/// result does not depend on `jobs`.
SolveResult Solve(const SolveRequest& request);

}  // namespace hoplab
