#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// Sentences about signs, orders and units that the data seem to have otherwise than this project:
/// the signs of x, of the pitch and of the angles of a robot's legs, the order of its legs or of
/// their columns, pitch or legs in degrees. The first six train trials are simulated at the nominal
/// values for half a second, as it stands and with one of these turned. One is told where what is
/// recorded is missed by a fifth of its motion or more as it stands, and by less than half as much,
/// and less than three tenths, with that one turned.
std::vector<std::string> TurnedAxes(const FitProblem& problem);

}  // namespace hoplab
