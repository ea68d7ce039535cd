#pragma once

#include <Eigen/QR>

#include "fitting/trial_evaluator.h"

namespace hoplab {

/// A trial as a least-squares solver needs it: of its residuals r and scaled Jacobian J = Q R only
/// R, the part of Q' r along it, and one row more with the length of the rest of r. The sum of
/// squares, J' r and J' J are those of the whole, and so is every Gauss-Newton step; the rows are
/// as few as the columns and one. (Golub & Van Loan, Matrix Computations, 5.3.)
class ReducedTrial {
 public:
  /// Where the whole is worked on, kept to spare its allocation.
  struct Workspace {
    Eigen::MatrixXd jacobian;
    Eigen::VectorXd residuals;
    Eigen::HouseholderQR<Eigen::MatrixXd> qr;
  };

  /// `residuals` rows and `columns` columns of the whole.
  ReducedTrial(int residuals, int columns);

  /// Of a complete evaluation; column k of its Jacobian is taken times `scale[k]`.
  void Reduce(const TrialEvaluation& evaluation, const Eigen::VectorXd& scale, Workspace& whole);

  int rows() const { return static_cast<int>(residuals_.size()); }
  const Eigen::VectorXd& residuals() const { return residuals_; }
  const Eigen::MatrixXd& jacobian() const { return jacobian_; }

 private:
  Eigen::VectorXd residuals_;
  Eigen::MatrixXd jacobian_;
};

}  // namespace hoplab
