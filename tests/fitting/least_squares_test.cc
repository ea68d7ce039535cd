// The solver's front of the fitting library, as the identification uses it.
#include "fitting/least_squares.h"

#include <gtest/gtest.h>

namespace hoplab {
namespace {

TEST(LeastSquares, SolvesRosenbrocksValleyWithinBounds) {
  LeastSquaresRequest request;
  request.residual_count = 2;
  request.start = Eigen::Vector2d(-1.2, 1.0);
  request.lower = Eigen::Vector2d(-3.0, -3.0);
  request.upper = Eigen::Vector2d(3.0, 3.0);
  request.evaluate = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    r[0] = 10.0 * (x[1] - x[0] * x[0]);
    r[1] = 1.0 - x[0];
    if (jacobian) *jacobian << -20.0 * x[0], 10.0, -1.0, 0.0;
    return true;
  };
  const LeastSquaresResult free = SolveLeastSquares(request);
  EXPECT_EQ(free.status, LeastSquaresResult::Status::kConverged);
  EXPECT_NEAR(free.x[0], 1.0, 1e-8);
  EXPECT_NEAR(free.x[1], 1.0, 1e-8);
  request.upper[0] = 0.5;
  EXPECT_NEAR(SolveLeastSquares(request).x[0], 0.5, 1e-8);
  request.evaluate = [](const auto&, auto&, auto*) { return false; };
  EXPECT_EQ(SolveLeastSquares(request).status, LeastSquaresResult::Status::kNoStart);
}

}  // namespace
}  // namespace hoplab
