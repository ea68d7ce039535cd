#pragma once

#include <Eigen/Core>

namespace hoplab {

/// What is left of `n` even samples beside the parabola through them that misses them least: a
/// projection.
Eigen::MatrixXd LeftByParabola(int n);

}  // namespace hoplab
