#pragma once

#include <array>
#include <optional>

#include "experiments/identification/study_data.h"
#include "experiments/identification/study_model.h"

namespace hoplab {

/// Derivatives with respect to the logarithms of the constants.
using StudySlopes = std::array<double, kStudyConstantCount>;

/// Energy left after the jump of a cell of table 6.5, in percent; its slopes from the simulator's
/// sensitivities where `slopes` is given. Nothing where the jump ends in a fall.
std::optional<double> EnergyPercent(const StudyHopper& hopper, const EnergyCell& cell,
                                    StudySlopes* slopes = nullptr);

}  // namespace hoplab
