#pragma once

#include <cstddef>
#include <span>

namespace hoplab {

/// One column with its times, s.
struct SampledColumn {
  std::span<const double> times;
  std::span<const double> values;  // NaN = missing
};

/// How alike the third differences of neighbouring samples are, where the motion is at its
/// quietest: the median over short windows of their correlation, at that distance of samples, up to
/// kApart_s, at which it is largest. Of white noise - 0.55; of noise that went through a filter it
/// is positive, since a filter leaves no difference between neighbours. NaN where there are too few
/// samples, or fewer than a hundred a second.
double SmoothnessOfNoise(std::span<const SampledColumn> columns);
/// Whether it is positive.
bool IsSmoothed(std::span<const SampledColumn> columns);
/// Whether a body's coordinates went through a filter, by the SmoothnessOfNoise of each: one is
/// positive, and none is that of white noise. One alone may be known so well that its differences
/// are those of the motion.
bool AreSmoothed(std::span<const double> smoothness);

/// From row to row, the median: gaps do not count [s]. 0 of less than two.
double UsualStep(std::span<const double> times);

/// Samples that are compared lie at most so far apart: a stance lasts longer [s].
inline constexpr double kApart_s = 0.01;
/// How many rows make that, one at least, where so much lies from row to row [s].
std::size_t RowsApart(double step);
std::size_t ApartIn(std::span<const SampledColumn> columns);

}  // namespace hoplab
