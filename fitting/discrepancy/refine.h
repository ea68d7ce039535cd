#pragma once

#include <atomic>
#include <vector>

#include "fitting/discrepancy/estimate_discrepancy.h"
#include "fitting/solve.h"

namespace hoplab {

/// Values fitted under the noise that suits them, and that noise.
struct RefinedFit {
  SolveResult at;                   // of the last search, under `discrepancy.noise`
  DiscrepancyEstimate discrepancy;  // at these values
};

struct RefineRequest {
  const std::vector<TrialProblem>* trials = nullptr;
  Eigen::VectorXd shared;  // where to begin: fitted, under white noise or a known one
  std::vector<OwnValues> starts;
  std::vector<int> held;  // shared values held one by one
  Loss loss;
  int max_iterations = 40;  // of each search
  double function_tolerance = 1e-12;
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
  /// The problem's noise is near the one sought: look no further.
  bool noise_is_near = false;
};

/// Alternates between the noise that suits the residuals and the values that suit the noise, until
/// neither moves; `problem.noise` becomes what is found. Where no discrepancy pays the noise is
/// white, and nothing is searched again if it was white before.
RefinedFit Refine(FitProblem& problem, const RefineRequest& request);

}  // namespace hoplab
