#pragma once

#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// Sentences about pairs of trials whose touch-down angles, or these and their starts, seem to have
/// been written to each other. Every trial is simulated at the nominal values for half a second,
/// with what is stated of it, and with what is stated of another one. A pair is told where both are
/// missed by an eighth of their motion or more as they stand, both by less with each other's, and
/// the two together by two fifths or less. Of trials that are missed so much the first forty are
/// looked at; a robot's are not, nor is what comes later than half a second.
std::vector<std::string> MixedUpTrials(const FitProblem& problem);

}  // namespace hoplab
