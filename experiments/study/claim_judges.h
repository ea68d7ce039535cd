#pragma once

#include "experiments/study/study_tables.h"

namespace hoplab {

// The claims of the study's text, judged on runs that were made before: what has to hold, with the
// figures that decide it. A run that shows nothing of a claim does not hold it.

/// (a) Apex lower with damping; leg length falls, then rises in stance; rolling, the leg is longer
/// and softer at lift-off; upright, its stiffness rises again before lift-off.
struct SingleJumps {
  HoppingRun upright_undamped, upright_damped, rolling_undamped, rolling_damped;
};
std::vector<StudyCheck> JudgeSingleJumps(const SingleJumps& runs);

/// (b) From rest at 15 deg: nearly vertical hops, then backward speed, then a fall; forward below
/// 15 deg, backward above; with damping it falls sooner.
struct HoppingFromRest {
  HoppingRun undamped, damped;
  HoppingRun smaller_angle, larger_angle;  // undamped
};
std::vector<StudyCheck> JudgeFromRest(const HoppingFromRest& runs);

/// (c) From 1 m/s at 20 deg: faster and lower every hop; with damping slower, and more hops.
std::vector<StudyCheck> JudgeForward(const HoppingRun& undamped, const HoppingRun& damped);

/// (d) Controlled: speed and height settle, far from the desired speed; damped sooner and lower.
std::vector<StudyCheck> JudgeControlled(const HoppingRun& undamped, const HoppingRun& damped,
                                        double v_des_m_per_s);

/// (e) The straight leg reaches the speed, height and energy grow to the end.
std::vector<StudyCheck> JudgeStraightLeg(const HoppingRun& undamped, double v_des_m_per_s);

/// (f) Every start converges; damped sooner. Times in s, NaN for no convergence.
std::vector<StudyCheck> JudgeInitialStates(const std::vector<double>& undamped,
                                           const std::vector<double>& damped);

/// (g) Convergence time without trend in E if undamped, falling if damped; stiffness grows.
std::vector<StudyCheck> JudgeModulus(const ModulusSweep& undamped, const ModulusSweep& damped);

/// (h) Energy is gained without damping, the less the larger the touch-down angle (ascending).
std::vector<StudyCheck> JudgeEnergyGain(const std::vector<double>& percent);

}  // namespace hoplab
