#pragma once

#include <vector>

#include "fitting/trace_faults.h"

namespace hoplab {

/// The samples near the ends of a hopper's or a ball's traces that went through a filter
/// (NoiseShapeOf). A filter has none beyond an end and makes them up, so the motion is bent there
/// for some five of its time constants, as the noise tells them, to and fro; of a filter that looks
/// back twice as long, at the beginning alone; for the width of a moving average. At either end at
/// most an eighth of a trial counts. A fault a trial, channel and end.
std::vector<TraceFault> FindSmoothedEnds(const Dataset& dataset);

}  // namespace hoplab
