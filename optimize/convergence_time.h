#pragma once

#include <limits>
#include <span>
#include <vector>

#include "model/trajectory.h"

namespace hoplab {

/// Forward speed at an apex.
struct ApexSpeed {
  double time = 0.0;  // s since the start
  double vx = 0.0;    // m/s
};

/// The apexes of a run, in their order; the start is none of them.
std::vector<ApexSpeed> ApexSpeeds(const Trajectory& run);

/// Convergence time (M23). Where the band is `kNone` time and hops are missing, not 0.
struct ConvergenceTime {
  enum class Band {
    kNone,        // no convergence
    kOnePercent,  // vx stays within 1 % of the steady speed
    kTwoPercent   // not within 1 %, but within 2 %: printed with an asterisk
  };
  Band band = Band::kNone;
  /// Time of the first apex from which on every apex lies in the band [s].
  double time = std::numeric_limits<double>::quiet_NaN();
  int hops = -1;  // place of that apex, the first one being 1
  /// Mean of vx over the last five apexes [m/s]; NaN where there are fewer.
  double steady_speed = std::numeric_limits<double>::quiet_NaN();
  /// Largest deviation of these five from their mean, over the mean.
  double spread = std::numeric_limits<double>::quiet_NaN();

  bool converged() const { return band != Band::kNone; }
};
ConvergenceTime ConvergenceTimeOf(std::span<const ApexSpeed> apexes);

}  // namespace hoplab
