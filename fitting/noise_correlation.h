#pragma once

#include <span>

#include "datasets/smoothness.h"

namespace hoplab {

/// Correlation rho of the noise of neighbouring samples, as of first order in time (AR(1)), from
/// samples in flight alone; the others are NaN. Parabolas through short windows take more of a
/// correlated noise away than of a white one, and rho is the one for which they would leave what
/// they do leave. 0 where rho is not clearly above a small one, where windows are too long for
/// a flight to be a parabola (fewer than 91 samples a second), and where what is left is smoother
/// than such noise can be: there the body moves otherwise than in a parabola, a leg swings.
double NoiseCorrelation(std::span<const SampledColumn> columns);

/// How many times as strong as one sample of such noise white noise must be to do the same to a
/// slow motion: sqrt((1 + rho)/(1 - rho)), the square root of its spectral density at frequency 0
/// over that of white noise.
double WhiteStrength(double correlation);

/// How many times its own standard deviation EstimateNoise finds of it.
double SeenByParabolas(double correlation);

}  // namespace hoplab
