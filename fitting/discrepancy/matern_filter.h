#pragma once

#include <Eigen/Core>
#include <span>

namespace hoplab {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Whitens rows of measurements with covariance I + ratio^2 K, K the Matern 3/2 correlation of
/// their times: replaces them by L^-1 times them, L the Cholesky factor in the order of time, by a
/// Kalman filter over the process' two states (Hartikainen and Saerkkae 2010):
///   lambda = sqrt(3)/time_scale
///   A(dt) = exp(-lambda dt) [[1 + lambda dt, dt], [-lambda^2 dt, 1 - lambda dt]]
///   P0 = diag(ratio^2, ratio^2 lambda^2),  P <- A (P - P0) A' + P0
/// The filter is linear and its gains know no data, so residuals and columns of a Jacobian go
/// through it alike. `rows` are the places of the measurements in `block`, `times` [s] ascending,
/// of the same length. Returns half the logarithm of the determinant of the covariance;
/// `log_roots`, if there, gets what each row adds to it, at the row's place.
double WhitenMatern(std::span<const double> times, std::span<const int> rows, double ratio,
                    double time_scale, Eigen::Ref<RowMajorMatrix> block,
                    Eigen::VectorXd* log_roots = nullptr);

/// columns' (ratio^2 K) columns, K as above of the rows `rows` of `columns`, by one pass over the
/// rows: with the sums s0_i = sum_(j<=i) exp(-lambda (t_i - t_j)) c_j and s1_i, the same weighted
/// by lambda (t_i - t_j), row i of the lower half of K times the columns is s0_i + s1_i.
Eigen::MatrixXd MaternProduct(std::span<const double> times, std::span<const int> rows,
                              double ratio, double time_scale, const Eigen::MatrixXd& columns);

}  // namespace hoplab
