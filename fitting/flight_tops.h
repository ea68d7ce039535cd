#pragma once

#include <cstddef>
#include <vector>

namespace hoplab {

/// The coordinates of a trial in even rows, NaN where one is missing; `x` empty where there is
/// none.
struct PlaceTrace {
  std::vector<double> times, x, y;
  double gravity = 0.0;  // [m/s^2]
};

/// Windows of kSamples about the tops of flights, 10 ms (kApart_s) from sample to sample or the
/// next less that rows allow. There a hopper's coordinates are parabolas, as far as may be from
/// what a filter makes of a stance.
struct FlightTops {
  static constexpr int kSamples = 12;
  struct Top {
    std::size_t trial, first;  // row
  };
  std::size_t stride = 1;  // rows from sample to sample
  double step = 0.0;       // from row to row, the median of the trials' means [s]
  std::vector<Top> found;

  /// Of a window.
  std::size_t rows() const { return (kSamples - 1) * stride + 1; }
};
/// A body falls freely from the highest sample to three steps of a window beyond both its ends.
/// Rows that were left out are put into the traces, missing.
FlightTops FindFlightTops(std::vector<PlaceTrace>& traces);

}  // namespace hoplab
