#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// A sentence about a hip torque that is none in flight and there one row later, in most trials:
/// from a touch-down to that row the simulation has none of it (held) or a part (linear), and then
/// the rest at once, or nearly.
std::vector<std::string> StanceTorques(const FitProblem& problem);

}  // namespace hoplab
