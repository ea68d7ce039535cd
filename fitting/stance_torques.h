#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// A sentence about a hip torque that is none in flight and all there one row later, in most
/// trials: from a touch-down to that row the simulation would have none, and then a blow.
std::vector<std::string> StanceTorques(const FitProblem& problem);

}  // namespace hoplab
