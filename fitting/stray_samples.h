#pragma once

#include <cstddef>
#include <vector>

namespace hoplab {

/// The samples of one channel of one trial that are there.
struct Samples {
  std::vector<double> t, y;      // [s], the channel's unit
  std::vector<std::size_t> row;  // of the trace
  double step = 0.0;             // median time from one to the next [s]
  std::size_t size() const { return t.size(); }
  Samples Without(const std::vector<bool>& left_out) const;
  /// Without the first ones.
  Samples From(std::size_t first) const;
};

/// Which samples repeat the one before to the last digit where chance cannot have made it so: the
/// noise is far greater than a digit, or than the grid of the sensor, and the body has moved on
/// meanwhile, or moves both before and after, or the sensor held another channel in the same rows
/// (`held_rows`, by the rows of the trace; empty: not known).
std::vector<bool> RepeatedSamples(const Samples& samples, const std::vector<bool>& held_rows = {});

/// What lies off the motion beside it, and the rows from which on the motion goes on elsewhere.
struct OffMotion {
  std::vector<std::size_t> stray, jumps;           // rows of the trace, ascending
  double largest_stray = 0.0, largest_jump = 0.0;  // [the channel's unit]
};
/// `sigma`: standard deviation of the noise; `least`: distances below it are of no interest. The
/// rules are those of FindTraceFaults.
/// `blow`: what a blow may change the speed by within one step, over the fastest that is seen.
OffMotion FindOffMotion(const Samples& samples, double sigma, double least, double blow);

}  // namespace hoplab
