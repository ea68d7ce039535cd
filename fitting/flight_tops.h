#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace hoplab {

/// The coordinates of a trial as they were logged; `x` empty where there is none.
struct PlaceTrace {
  std::span<const double> times, x, y;
  double gravity;  // [m/s^2]
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
  double step = 0.0;       // from row to row, the median of the trials [s]
  std::vector<Top> found;

  double apart() const { return static_cast<double>(stride) * step; }
  /// One window of a column of its trial.
  Eigen::VectorXd Window(const Top& top, std::span<const double> column) const;
};
/// A body falls freely from the highest sample to three steps of a window beyond both its ends.
FlightTops FindFlightTops(std::span<const PlaceTrace> traces);

/// Time constant [s] of the filter (M105) that the coordinates went through before they were
/// logged, by their noise alone; infinite where there was none of up to 30 Hz. There was one where
/// the noise of all traces looks so (AreSmoothed), and where that at the tops of six flights or
/// more is alike in neighbours. Without the tops, what looks slow may be the motion.
double FilterTimeOf(std::span<const PlaceTrace> traces, const FlightTops& tops);

}  // namespace hoplab
