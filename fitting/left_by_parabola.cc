#include "fitting/left_by_parabola.h"

#include <Eigen/Dense>

namespace hoplab {

Eigen::MatrixXd LeftByParabola(int n) {
  Eigen::MatrixXd powers(n, 3);
  for (int i = 0; i < n; ++i) {
    const double s = 2.0 * i / (n - 1) - 1.0;
    powers.row(i) << 1.0, s, s * s;
  }
  const Eigen::MatrixXd q = powers.householderQr().householderQ() * Eigen::MatrixXd::Identity(n, 3);
  return Eigen::MatrixXd::Identity(n, n) - q * q.transpose();
}

}  // namespace hoplab
