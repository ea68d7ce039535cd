#pragma once

#include <string>

#include "fitting/problem.h"

namespace hoplab {

/// How much of a trial is looked at before anything is fitted: a hop or so. Later a motion goes
/// apart at its own pace.
inline constexpr double kFirstMotion_s = 0.5;

/// The mean square of what a simulation at the nominal values misses of the motion, over that
/// motion's own, the mean over the channels of the body's pose and of a robot's legs: 0 where it
/// follows, 1 where it is nowhere near or ends.
double MissedMotion(const FitProblem& problem, const TrialProblem& trial);

/// The same at other shared values.
double MissedMotion(const FitProblem& problem, const TrialProblem& trial,
                    const Eigen::VectorXd& shared);

/// Such a share as a text: its root in per cent.
std::string MissedPercent(double missed);

}  // namespace hoplab
