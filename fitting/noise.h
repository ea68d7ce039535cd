#pragma once

#include <span>
#include <vector>

namespace hoplab {

/// One column with its times, s.
struct SampledColumn {
  std::span<const double> times;
  std::span<const double> values;  // NaN = missing
};

/// Standard deviation of white noise on a channel, from the traces alone: in flight a hopper's
/// coordinates are parabolas of time, so parabolas are laid through short windows. Windows that
/// meet a stance miss by far more than noise and are set aside; the median of the others' residual
/// variances counts (corrected for the median of chi-square).
/// NaN when there are fewer than 3 windows of 8 samples.
double EstimateNoise(std::span<const SampledColumn> columns);

}  // namespace hoplab
