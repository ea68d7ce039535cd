#pragma once

#include <cstdint>

#include "optimize/search_point.h"

namespace hoplab {

/// How far to go from a point that was found.
struct RobustnessOptions {
  double stiffness_range = 0.05;  // E, or k of a straight leg: both ways, relative
  int stiffness_points = 11;
  double speed_range = 0.2;  // of the start: both ways, relative
  double height_range = 1.0 / 3.0;
  double robot_height_range = 0.1;        // a robot begins near the ground
  int start_points = 5;                   // per axis: the published study's grid
  double touchdown_noise = 0.0087266463;  // 1 standard deviation of every landing [rad]: 0.5 deg
  int noise_runs = 20;
  std::uint64_t seed = 1;
  int jobs = 1;
};

/// The same point under changed circumstances: how many of the runs converge, and how late at
/// worst.
struct WorstCase {
  int runs = 0;
  int converged = 0;  // into the 1 % band, or the 2 % band
  int ended = 0;      // fell, found no support, ...
  double worst_time = std::numeric_limits<double>::quiet_NaN();  // s, of those that converge
};

/// Hopping with a touch-down angle that is off by an independent normal draw at every landing.
struct NoisyHops {
  int runs = 0;
  int fell = 0;
  double speed_deviation =
      std::numeric_limits<double>::quiet_NaN();  // 1 sd of vx at the apexes of the second half,
                                                 // over its mean
};

struct Robustness {
  WorstCase stiffness, initial_states;
  NoisyHops noise;
};

/// Tries `hopper` out: stiffness and initial states one after the other, in runs as long as its
/// own; the noise hop by hop.
Robustness AssessRobustness(const Hopper& hopper, const RobustnessOptions& options = {});

}  // namespace hoplab
