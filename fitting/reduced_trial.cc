#include "fitting/reduced_trial.h"

#include <algorithm>

namespace hoplab {

ReducedTrial::ReducedTrial(int residuals, int columns)
    : residuals_(std::min(residuals, columns + 1)),
      jacobian_(residuals_.size(), columns),
      qr_(residuals, columns) {}

void ReducedTrial::Reduce(const TrialEvaluation& evaluation, const Eigen::VectorXd& scale) {
  const Eigen::Index columns = jacobian_.cols();
  whole_ = evaluation.jacobian * scale.asDiagonal();
  if (whole_.rows() <= columns + 1) {
    residuals_ = evaluation.residuals;
    jacobian_ = whole_;
    return;
  }
  qr_.compute(whole_);
  whole_residuals_ = evaluation.residuals;
  whole_residuals_.applyOnTheLeft(qr_.householderQ().adjoint());
  residuals_.head(columns) = whole_residuals_.head(columns);
  residuals_[columns] = whole_residuals_.tail(whole_residuals_.size() - columns).norm();
  jacobian_.setZero();
  jacobian_.topRows(columns).triangularView<Eigen::Upper>() =
      qr_.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
}

}  // namespace hoplab
