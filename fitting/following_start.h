#pragma once

#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// Shared values from which a simulation of a robot's first half second follows its trials:
/// `shared` where what is missed (MissedMotion) is less than a fifth of the motion, else `shared`
/// with all its stiffnesses by one factor on a ladder from 1/15 to 15, where least is missed, and
/// less than half of that (mean squares). Where a leg gives way no search begins.
Eigen::VectorXd FollowingStart(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                               const Eigen::VectorXd& shared, int jobs);

}  // namespace hoplab
