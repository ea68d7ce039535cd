#pragma once

#include <vector>

#include "experiments/kinematics/two_legs.h"

namespace hoplab {

/// The task of thesis 3.3: a laser on the body is to sweep a range of pitch with both legs on the
/// ground. Angles in rad.
struct LaserScanRequest {
  TwoLegs legs;
  double start_low = 0.0, start_high = 0.0;  // both start angles, inclusive
  int initial_states = 2;                    // per leg
  double wanted_low = 0.0, wanted_high = 0.0;
  int jobs = 1;
};

/// What can be reached from one pair of start angles.
struct ScanStart {
  LegAngles angles;
  PoseOutcome outcome = PoseOutcome::kReached;  // of the start itself
  double start_pitch = 0.0;
  Travel travel{};
  PitchRange range;
  bool feasible = false;  // the range includes the wanted one
};

/// One pair.
ScanStart ScanFrom(const LaserScanRequest& request, LegAngles angles);

/// All pairs, the front angle fastest.
std::vector<ScanStart> ScanInitialStates(const LaserScanRequest& request);

/// Poses along the whole travel from one start, evenly spaced in the rear angle.
std::vector<Pose> PosesAlong(const RollingPair& pair, const Travel& travel, int count);

}  // namespace hoplab
