#pragma once

#include <array>

#include "app/records/run_record.h"
#include "model/simulate.h"

namespace hoplab {

/// In the order in which laws are listed.
inline constexpr std::array kMechanisms = {MechanismKind::kCLeg, MechanismKind::kStraightLeg,
                                           MechanismKind::kBall, MechanismKind::kRobot};

/// What `hoplab laws --json` prints.
Json LawsRecord();

}  // namespace hoplab
