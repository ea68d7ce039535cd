#include "fitting/reduced_trial.h"

#include <algorithm>

namespace hoplab {

ReducedTrial::ReducedTrial(int residuals, int columns)
    : residuals_(std::min(residuals, columns + 1)), jacobian_(residuals_.size(), columns) {}

void ReducedTrial::Reduce(const TrialEvaluation& evaluation, const Eigen::VectorXd& scale,
                          Workspace& whole) {
  const Eigen::Index columns = jacobian_.cols();
  whole.jacobian = evaluation.jacobian * scale.asDiagonal();
  if (whole.jacobian.rows() <= columns + 1) {
    residuals_ = evaluation.residuals;
    jacobian_ = whole.jacobian;
    return;
  }
  whole.qr.compute(whole.jacobian);
  whole.residuals = evaluation.residuals;
  whole.residuals.applyOnTheLeft(whole.qr.householderQ().adjoint());
  residuals_.head(columns) = whole.residuals.head(columns);
  residuals_[columns] = whole.residuals.tail(whole.residuals.size() - columns).norm();
  jacobian_.setZero();
  jacobian_.topRows(columns).triangularView<Eigen::Upper>() =
      whole.qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
}

}  // namespace hoplab
