#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// Channels of a body's pose that were smoothed before they were logged, by their noise alone.
std::vector<Channel> SmoothedChannels(const FitProblem& problem);
/// Sentences about them.
std::vector<std::string> SmoothedTraces(const FitProblem& problem);

}  // namespace hoplab
