#pragma once

#include <limits>
#include <string>
#include <vector>

#include "app/runs/problem_settings.h"
#include "datasets/dataset.h"
#include "fitting/check.h"

namespace hoplab {

/// What the command line of `hoplab check` says.
struct CheckSettings : RunSettings {
  ProblemSettings problem;
};

/// What the traces alone show of a channel's noise.
struct ChannelNoise {
  std::string channel, unit;
  double stated = std::numeric_limits<double>::quiet_NaN();  // NaN: to be estimated
  double in_traces = 0.0;                                    // NaN: too few samples
};

/// All that `hoplab check` computes.
struct CheckRun {
  FitProblem problem;
  CheckReport check;
  std::vector<ChannelNoise> noise;
};
CheckRun RunCheck(const Dataset& dataset, const ProblemOptions& options, int jobs);

}  // namespace hoplab
