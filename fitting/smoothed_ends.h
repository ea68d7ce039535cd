#pragma once

#include <vector>

#include "fitting/trace_faults.h"

namespace hoplab {

/// The samples near the ends of a hopper's or a ball's traces that were smoothed (FilterTimeOf). A
/// filter has none beyond an end and makes them up, so the motion is bent there for some five of
/// its time constants, as the noise tells them; at either end at most an eighth of a trial counts.
/// A fault a trial, channel and end.
std::vector<TraceFault> FindSmoothedEnds(const Dataset& dataset);

}  // namespace hoplab
