#pragma once

#include <span>
#include <string>
#include <vector>

#include "fitting/noise.h"
#include "fitting/problem.h"

namespace hoplab {

/// How alike the third differences of neighbouring samples are, where the motion is at its
/// quietest: the median over short windows of their correlation, at that distance of samples at
/// which it is largest. Of white noise - 0.55; of noise that went through a filter it is positive,
/// since a filter leaves no difference between neighbours. NaN where there are too few samples.
double SmoothnessOfNoise(std::span<const SampledColumn> columns);

/// Channels of a body's pose that were smoothed before they were logged, by their noise alone.
std::vector<Channel> SmoothedChannels(const FitProblem& problem);
/// Sentences about them.
std::vector<std::string> SmoothedTraces(const FitProblem& problem);

}  // namespace hoplab
