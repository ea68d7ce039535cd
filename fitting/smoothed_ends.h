#pragma once

#include <vector>

#include "fitting/trace_faults.h"

namespace hoplab {

/// The samples near the ends of traces that were smoothed (FilterTimeOf): a filter has none beyond
/// an end and makes them up, so that the motion is bent there for some five of its time constants
/// (of M105, as the noise tells it; at most an eighth of a trial). A fault a trial, channel and
/// end.
std::vector<TraceFault> FindSmoothedEnds(const Dataset& dataset);

}  // namespace hoplab
