#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/identification/study_data.h"
#include "experiments/identification/study_model.h"

namespace hoplab {

/// Residuals whose sum of squares is the smooth part of the misfit, table 6.5 and with `stiffness`
/// the ranges, for a least-squares solver: energy with slopes from the sensitivities, stiffness by
/// differences. Columns belong to the logarithms of the constants in `free`. False where a run
/// fails.
int ResidualCount(const StudyData& data, bool stiffness);
bool ResidualsOf(const StudyHopper& hopper, const StudyData& data, bool stiffness,
                 const std::vector<StudyConstant>& free, Eigen::VectorXd& residuals,
                 Eigen::MatrixXd* jacobian);

}  // namespace hoplab
