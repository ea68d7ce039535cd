#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"
#include "model/effects/effect.h"

namespace hoplab {

/// Filters of which a body's pose has the noise (NoiseShapeOf); where too few flights are seen, one
/// without lag if its neighbours are alike.
std::vector<RecordFilter> FiltersSeen(const FitProblem& problem);
/// Channels of a body's pose that were smoothed before they were logged, by their noise alone.
std::vector<Channel> SmoothedChannels(const FitProblem& problem);
/// Sentences about them.
std::vector<std::string> SmoothedTraces(const FitProblem& problem);

}  // namespace hoplab
