#pragma once

#include <string>

#include "model/parameters.h"
#include "tests/support/beam_extras.h"

namespace hoplab::testing {

/// MuJoCo's text of a robot with the parameters `p`, each of its legs a chain of arcs; its joints
/// are x, y, pitch and hip0, hip1, ..., the motors those of the hips.
std::string BeamRobotText(const Parameters<double>& p, const BeamExtras& extras = {});

}  // namespace hoplab::testing
