#pragma once

#include <vector>

namespace hoplab {

/// What is added to a simulation to make a measurement: white noise of the channels' sigma, and a
/// model discrepancy, a zero-mean Gaussian process of its own in each trial and channel with Matern
/// 3/2 covariance: amplitude common to all trials of a channel, time scale common to all. White
/// noise alone counts every sample of a smooth systematic error as a proof of its own. (Kennedy and
/// O'Hagan 2001.)
struct NoiseModel {
  /// One standard deviation of the discrepancy, per problem channel, in units of the channel's
  /// sigma; empty or 0: white.
  std::vector<double> amplitude;
  double time_scale = 0.0;  // ell [s], lambda = sqrt(3)/ell

  bool IsWhite() const {
    for (const double a : amplitude) {
      if (a > 0.0) return false;
    }
    return true;
  }
  double AmplitudeOf(std::size_t channel) const {
    return channel < amplitude.size() ? amplitude[channel] : 0.0;
  }
  bool operator==(const NoiseModel&) const = default;
};

}  // namespace hoplab
