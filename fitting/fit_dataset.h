#pragma once

#include <optional>
#include <string>

#include "fitting/fit.h"

namespace hoplab {

/// What one residual block spans.
enum class FitSpan {
  kWholeElseHops,  // whole traces; where none of them can be simulated to its end, single hops
  kWhole,          // whole traces or nothing
  kHops            // single hops, each with a start of its own
};
std::string_view NameOf(FitSpan span);
std::optional<FitSpan> FindSpan(std::string_view name);

struct DatasetFit {
  FitProblem problem;  // the one that was fitted: trials are hops if `by_hop`
  FitResult result;
  bool by_hop = false;
  std::string note;  // why it was fitted hop by hop, or that hops and whole traces disagree
};

/// Sets up and fits a dataset. A law that cannot carry a simulation through a whole trace (it falls
/// where the hopper did not, whatever the parameters) is still fitted to single hops, which is
/// said. Throws InputError as MakeProblem does.
DatasetFit FitDataset(const Dataset& dataset, const ProblemOptions& problem_options,
                      const FitOptions& fit_options, FitSpan span = FitSpan::kWholeElseHops);

/// The same of a problem that is set up already.
DatasetFit FitTraces(FitProblem problem, const FitOptions& fit_options,
                     FitSpan span = FitSpan::kWholeElseHops);

}  // namespace hoplab
