#pragma once

#include <Eigen/Core>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// Where searches can begin whose values have a threshold (EffectInfo::has_threshold): below it
/// they change nothing and have no derivative, so that a search from their null stays there.
/// `shared` with those values, of those from place `first` on or at their null, at each of a few
/// sizes about their typical one; empty if there is none. They are several, since beyond it other
/// values that stand in for them have to give way. What is at a null that is its bound begins at
/// its typical size: without it the others may not show (EffectInfo::shows_beside).
std::vector<Eigen::VectorXd> BeginningsBeyondThresholds(const FitProblem& problem,
                                                        const Eigen::VectorXd& shared,
                                                        int first = 0);

}  // namespace hoplab
