#pragma once

#include <span>
#include <vector>

#include "fitting/flight_tops.h"
#include "model/effects/effect.h"

namespace hoplab {

/// What made a coordinate's white noise alike in neighbouring samples.
struct NoiseShape {
  RecordFilter filter = RecordFilter::kNone;  // kNone: nothing, it is white
  double time = 0.0;                          // of the filter [s]
  double strength = 1.0;   // how many times as strong white noise does the same to a slow motion
  double white = 0.0;      // its variance over the filtered one's: rounding
  double better_by = 0.0;  // than white noise [nats]
  std::vector<double> sigma = {};  // of x and of y as they were logged [m]; NaN: not told
};

/// Noise may be alike in neighbours as after a filter of first order without one.
inline bool IsSurelyOfFilter(RecordFilter filter) {
  return filter != RecordFilter::kNone && filter != RecordFilter::kFirstOrder;
}

/// The filter whose noise is likeliest, M118, from what parabolas leave at the tops of six flights
/// or more. White where no filter is likelier by kSurelyBetter.
NoiseShape FindNoiseShape(std::span<const PlaceTrace> traces, const FlightTops& tops);
inline constexpr double kSurelyBetter = 10.0;  // nats

/// White noise after a filter as it is run over samples `step` apart, and what it says at once.
struct FilteredWhite {
  std::vector<double> correlation;  // at lags of 0, 1, ... steps; the first is 1
  double strength = 1.0;  // root of its spectral density at frequency 0 over white noise's
};
FilteredWhite FilterWhite(RecordFilter filter, double time, double step, int lags);

}  // namespace hoplab
