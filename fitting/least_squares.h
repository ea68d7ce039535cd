#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>

namespace hoplab {

/// Residuals of a few unknowns whose sum of squares is to be made small within bounds.
struct LeastSquaresRequest {
  /// Fills residuals, and where `jacobian` is not null the derivatives (a row a residual). False
  /// where a point cannot be evaluated: the step to it is rejected.
  std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& residuals,
                     Eigen::MatrixXd* jacobian)>
      evaluate;
  int residual_count = 0;
  Eigen::VectorXd start, lower, upper;  // of one size
  int max_iterations = 50;
  const std::atomic<bool>* stop = nullptr;  // ends with the best so far
};

struct LeastSquaresResult {
  enum class Status { kConverged, kIterationLimit, kNoStart, kFailed, kInterrupted };
  Status status = Status::kFailed;
  Eigen::VectorXd x;
  double cost = 0.0;  // half the sum of squares
  int iterations = 0;
  bool usable() const { return status != Status::kNoStart && status != Status::kFailed; }
};

/// Levenberg-Marquardt by Ceres with bounds.
LeastSquaresResult SolveLeastSquares(const LeastSquaresRequest& request);

}  // namespace hoplab
