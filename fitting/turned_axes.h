#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// Sentences about signs and orders that the data seem to have otherwise than this project: x, the
/// pitch, the angles of a robot's legs, the order of the legs. The first six train trials are
/// simulated at the nominal values for half a second, as it stands and with one of these turned.
/// One is told where what is recorded of the body is missed by a fifth of its motion or more as it
/// stands, and by less than half as much, and less than three tenths, with that one turned.
std::vector<std::string> TurnedAxes(const FitProblem& problem);

}  // namespace hoplab
