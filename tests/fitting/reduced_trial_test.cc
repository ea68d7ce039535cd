#include "fitting/reduced_trial.h"

#include <gtest/gtest.h>

namespace hoplab {
namespace {

struct Whole {
  TrialEvaluation evaluation;
  Eigen::MatrixXd J;
  Eigen::VectorXd scale;
};

Whole Evaluation(int rows, int columns) {
  std::srand(7);
  Whole w;
  w.evaluation.complete = true;
  w.evaluation.residuals = Eigen::VectorXd::Random(rows);
  w.evaluation.jacobian = Eigen::MatrixXd::Random(rows, columns);
  w.scale = Eigen::VectorXd::LinSpaced(columns, 1e-3, 50.0);
  w.J = w.evaluation.jacobian * w.scale.asDiagonal();
  return w;
}

// All that a Gauss-Newton step and its trust region are made of.
void ExpectSameLeastSquares(const Whole& w, const ReducedTrial& reduced) {
  const Eigen::MatrixXd J = reduced.jacobian();
  const Eigen::VectorXd r = reduced.residuals();
  ASSERT_EQ(J.rows(), r.size());
  const double size = w.J.squaredNorm();
  EXPECT_LT((J.transpose() * J - w.J.transpose() * w.J).norm(), 1e-14 * size);
  EXPECT_LT((J.transpose() * r - w.J.transpose() * w.evaluation.residuals).norm(), 1e-14 * size);
  EXPECT_NEAR(r.squaredNorm(), w.evaluation.residuals.squaredNorm(), 1e-14 * r.squaredNorm());
}

TEST(ReducedTrial, IsTheSameLeastSquaresProblemInFewRows) {
  const Whole w = Evaluation(400, 9);
  ReducedTrial::Workspace workspace;
  ReducedTrial reduced(400, 9);
  reduced.Reduce(w.evaluation, w.scale, workspace);
  EXPECT_EQ(reduced.rows(), 10);
  ExpectSameLeastSquares(w, reduced);
}

TEST(ReducedTrial, FewRowsStayAsTheyAre) {
  for (int rows : {1, 9, 10}) {
    const Whole w = Evaluation(rows, 9);
    ReducedTrial::Workspace workspace;
    ReducedTrial reduced(rows, 9);
    reduced.Reduce(w.evaluation, w.scale, workspace);
    EXPECT_EQ(reduced.rows(), rows);
    EXPECT_EQ(reduced.residuals(), w.evaluation.residuals);
    EXPECT_EQ(reduced.jacobian(), w.J);
  }
}

TEST(ReducedTrial, AColumnOfZerosIsNoTrouble) {
  Whole w = Evaluation(50, 4);
  w.evaluation.jacobian.col(1).setZero();
  w.J.col(1).setZero();
  ReducedTrial::Workspace workspace;
  ReducedTrial reduced(50, 4);
  reduced.Reduce(w.evaluation, w.scale, workspace);
  ExpectSameLeastSquares(w, reduced);
}

}  // namespace
}  // namespace hoplab
