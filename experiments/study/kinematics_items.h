#pragma once

#include "experiments/kinematics/two_legs.h"
#include "experiments/study/study_result.h"

namespace hoplab {

// The two-legged kinematics of thesis ch. 3: a laser scanner on the body is to sweep 5 to 10 deg.

/// "figure-3.5" (highest and lowest pitch over the start angles), "figure-3.6" (start angles from
/// which the wanted range can be swept), "figure-3.7" (pitch over the rear motor's angle from 45
/// and 75 deg).
std::vector<std::string> KinematicsFigureNames();
StudyFigure RunKinematicsFigure(const std::string& name, const TwoLegs& legs, int jobs);

/// "claim-level" (equal start angles keep the body level), "claim-sign" (the sign of the starting
/// pitch never changes).
std::vector<std::string> KinematicsClaimNames();
StudyClaim RunKinematicsClaim(const std::string& name, const TwoLegs& legs, int jobs);

}  // namespace hoplab
