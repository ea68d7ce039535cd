#pragma once

#include <memory>

#include "bench/report.h"
#include "model/trajectory.h"

namespace hoplab::bench {

/// One second of a robot on two legs: ours with sensitivities and without, and the same as a model
/// of hinged arcs in MuJoCo where that is installed.
class RobotComparison {
 public:
  /// Adds our runs to `timer`, which must outlive this.
  explicit RobotComparison(RoundRobin& timer);
  /// One run of the peer.
  void Lap();
  /// Rows, bounds and notes. False if the two engines did not do the same.
  bool Collect(Report& report) const;

 private:
  struct Run {
    int directions;
    double leg_mass;
    int timing;
    std::shared_ptr<Trajectory> out;
  };
  const Run& OfBeams() const { return runs_[2]; }

  RoundRobin& timer_;
  std::vector<Run> runs_;
  Timing beams_;
  double step_ = 0.0, apart_m_ = 0.0, apart_rad_ = 0.0;
};

}  // namespace hoplab::bench
