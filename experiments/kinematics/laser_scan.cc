#include "experiments/kinematics/laser_scan.h"

#include <algorithm>

#include "base/parallel.h"

namespace hoplab {
namespace {

double AngleAt(const LaserScanRequest& request, int i) {
  return request.start_low +
         (request.start_high - request.start_low) * i / std::max(request.initial_states - 1, 1);
}

}  // namespace

ScanStart ScanFrom(const LaserScanRequest& request, LegAngles angles) {
  ScanStart scan{.angles = angles};
  const RollingPair pair(request.legs, angles);
  scan.outcome = pair.start().outcome;
  scan.start_pitch = pair.start().pose.pitch;
  scan.travel = TravelOf(pair);
  scan.range = PitchRangeOf(pair, scan.travel);
  scan.feasible =
      scan.range.lowest <= request.wanted_low && scan.range.highest >= request.wanted_high;
  return scan;
}

std::vector<ScanStart> ScanInitialStates(const LaserScanRequest& request) {
  const int n = request.initial_states;
  std::vector<ScanStart> scans(static_cast<std::size_t>(n) * n);
  ParallelFor(n * n, request.jobs, [&](int i) {
    scans[i] = ScanFrom(request, {AngleAt(request, i / n), AngleAt(request, i % n)});
  });
  return scans;
}

std::vector<Pose> PosesAlong(const RollingPair& pair, const Travel& travel, int count) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double psi = travel.low + (travel.high - travel.low) * i / std::max(count - 1, 1);
    const PoseResult at = pair.At(std::clamp(psi, travel.low, travel.high));
    if (at.outcome == PoseOutcome::kReached) poses.push_back(at.pose);
  }
  return poses;
}

}  // namespace hoplab
