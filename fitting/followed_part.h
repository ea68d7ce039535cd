#pragma once

#include <optional>

#include "fitting/fit.h"

namespace hoplab {

/// As much of every trial as a model can be fitted to.
struct FollowedPart {
  double share = 1.0;  // of each trial's time
  FitProblem problem;  // the one whose trials are cut there
  FitResult result;    // a minimum
};

/// Fits longer and longer first parts of all trials, up to the longest whose fit is a minimum. A
/// gait magnifies what is wrong with a model from stride to stride, until its simulation goes
/// another way than the robot and the least cost lies in no valley; the first stride can still be
/// fitted. Nothing where not even a fifth of the trials can.
std::optional<FollowedPart> FitFollowedPart(const FitProblem& problem, const FitOptions& options);

}  // namespace hoplab
