#pragma once

#include <string>
#include <vector>

#include "datasets/dataset.h"

namespace hoplab {

/// Sentences about what is legal in a dataset but probably not meant, each beginning with its
/// place: times in milliseconds, heights in millimetres, an angle in radians, a constant or single
/// sample, a start that is not in flight or moves otherwise than the trace begins, a sigma far from
/// the noise of the trace, no test trial. Empty for a dataset without such things.
std::vector<std::string> SuspectThings(const Dataset& dataset);

/// Why no hop of the dataset can be followed, with the remedy; empty if that is not so: every
/// trial falls at a millionth of gravity, as one whose times are milliseconds does.
std::string UnreadableTimes(const Dataset& dataset);

/// Standard deviation of the noise of `values` at `times_s`, from how far each sample lies off the
/// cubic through its four neighbours, two on each side, by the median. An upper estimate where the
/// motion is quick against the sample rate; NaN below 20 usable samples.
double HighFrequencyNoise(const std::vector<double>& times_s, const std::vector<double>& values);

/// Slope of the straight line through points, by the median of all pairs half of them apart.
double MedianSlope(const std::vector<double>& t, const std::vector<double>& y);

/// Downward acceleration in flight that a trace of heights shows [m/s^2 if its columns hold what
/// they say]: the curvature of parabolas laid through short windows, the tenth percentile from
/// below. NaN if there are fewer than 10 samples.
double ApparentGravity(const std::vector<double>& times_s, const std::vector<double>& heights_m);

}  // namespace hoplab
