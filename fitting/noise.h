#pragma once

#include <span>

#include "datasets/smoothness.h"

namespace hoplab {

/// Samples of one of its windows.
inline constexpr int kNoiseWindow = 12;

/// Standard deviation of white noise on a channel, from the traces alone: in flight a hopper's
/// coordinates are parabolas of time, so parabolas are laid through short windows. Windows that
/// meet a stance miss by far more than noise and are set aside; the median of the others' residual
/// variances counts (corrected for the median of chi-square).
/// Noise that was smoothed (IsSmoothed) does not show among neighbours: of it every sample is left
/// out but those kApart_s from another.
/// At a low rate, where such a window is longer than a flight, shorter ones are looked at, too, and
/// count where they give less than half.
/// Where many samples rest, no less than the digit's, the smallest step over sqrt(12): a motor that
/// rests shows one count of its encoder.
/// NaN when there are fewer than 3 windows of 8 samples.
double EstimateNoise(std::span<const SampledColumn> columns);

}  // namespace hoplab
