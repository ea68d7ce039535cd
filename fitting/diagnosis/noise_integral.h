#pragma once

#include <functional>

#include "fitting/discrepancy/noise_model.h"

namespace hoplab {

/// Time scales that a discrepancy may have [s].
struct TimeScaleRange {
  double shortest = 0.0, longest = 0.0;
};

/// Integral of a density over a discrepancy's own values.
struct NoiseIntegral {
  NoiseModel peak;          // where the density is largest
  double log_volume = 0.0;  // logarithm of the integral over the density at `peak`
};

/// Integrates a density over the logarithms of the amplitudes and of the time scale, the latter
/// within its range. From `begin`, which need not be the peak, Newton's method goes there. The
/// integral is Laplace's over the amplitudes and a quadrature over the time scale, which often lies
/// on an end of its range. `log_density` is per logarithm of each value.
NoiseIntegral IntegrateOverNoise(const NoiseModel& begin, const TimeScaleRange& range,
                                 const std::function<double(const NoiseModel&)>& log_density);

}  // namespace hoplab
