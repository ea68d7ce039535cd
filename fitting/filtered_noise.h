#pragma once

#include <optional>
#include <vector>

#include "fitting/noise_shape.h"
#include "fitting/problem.h"

namespace hoplab {

/// How the noise of a hopper's or a ball's coordinates is alike in neighbouring samples
/// (FindNoiseShape). White of a robot, whose legs land one by one.
NoiseShape NoiseShapeOf(const FitProblem& problem);
NoiseShape NoiseShapeOf(const Dataset& dataset);

/// Standard deviation of a channel's noise as it was logged, from the traces alone: EstimateNoise,
/// or, of a coordinate that went through a filter, which leaves neighbours alike, what its `noise`
/// says.
double NoiseInTraces(const Dataset& dataset, Channel channel, const NoiseShape& noise);

/// White noise that went through a filter before it was logged.
struct FilteredNoise {
  NoiseShape shape;
  std::vector<double> sigma;  // of each of the problem's channels, as it was logged; NaN: not told

  bool Tells(std::size_t channel) const { return sigma[channel] == sigma[channel]; }
};
/// None where the noise is white, or alike as noise often is without a filter (kFirstOrder).
std::optional<FilteredNoise> FindFilteredNoise(const FitProblem& problem);

}  // namespace hoplab
