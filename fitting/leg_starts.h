#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// A sentence where a robot's legs do not begin to turn as the simulation at the nominal values
/// turns them: in every train trial, some logged leg angle has another rate over the first 20 ms,
/// by half of the larger one and by 5 rad/s at least. A clock whose phase, duty, period or sweep is
/// another than stated may begin on the other of its two pieces, where no derivative sees this one.
std::vector<std::string> LegStarts(const FitProblem& problem);

/// A sentence for each column of a robot's leg angles that begins some whole turns off its motor's
/// angle, in every train trial as many.
std::vector<std::string> LegTurns(const FitProblem& problem);

}  // namespace hoplab
