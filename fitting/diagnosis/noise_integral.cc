#include "fitting/diagnosis/noise_integral.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace hoplab {
namespace {

// Coordinates: cube roots of the amplitudes, then the logarithm of the time scale. An amplitude
// that may be zero, with a density exp(-a^2/(2 s^2)), has a peak in its cube root y, at y^6 = 2
// s^2/3, and Laplace's integral there is right to 1.3 %; in the logarithm it is 14 % too small.
struct NoiseCoordinates {
  // Where an amplitude is zero the search for its peak begins here, in sigma.
  static constexpr double kSmallAmplitude = 0.2;

  static Eigen::VectorXd Of(const NoiseModel& noise) {
    const auto n = static_cast<Eigen::Index>(noise.amplitude.size());
    Eigen::VectorXd x(n + 1);
    for (Eigen::Index k = 0; k < n; ++k)
      x[k] = std::cbrt(std::max(noise.amplitude[static_cast<std::size_t>(k)], kSmallAmplitude));
    x[n] = std::log(noise.time_scale);
    return x;
  }
  static NoiseModel At(const Eigen::VectorXd& x) {
    NoiseModel noise;
    for (Eigen::Index k = 0; k + 1 < x.size(); ++k) noise.amplitude.push_back(x[k] * x[k] * x[k]);
    noise.time_scale = std::exp(x[x.size() - 1]);
    return noise;
  }
  // Of the logarithms per coordinate.
  static double LogJacobian(const Eigen::VectorXd& x) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k + 1 < x.size(); ++k) sum += std::log(3.0 / x[k]);
    return sum;
  }
};

// The density around a point: value, slope, and curvature, positive at a peak.
struct Quadratic {
  double value = 0.0;
  Eigen::VectorXd slope;
  Eigen::MatrixXd curvature;
};

template <class F>
Quadratic QuadraticAt(const F& f, const Eigen::VectorXd& x) {
  constexpr double kOfRoot = 0.02, kOfLogarithm = 0.05;
  const Eigen::Index n = x.size();
  Eigen::VectorXd h = kOfRoot * x;
  h[n - 1] = kOfLogarithm;
  const auto step = [&](Eigen::Index i) { return h[i] * Eigen::VectorXd::Unit(n, i); };
  Quadratic out{f(x), Eigen::VectorXd(n), Eigen::MatrixXd(n, n)};
  Eigen::VectorXd plus(n), minus(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    plus[i] = f(x + step(i));
    minus[i] = f(x - step(i));
    out.slope[i] = (plus[i] - minus[i]) / (2.0 * h[i]);
    out.curvature(i, i) = -(plus[i] + minus[i] - 2.0 * out.value) / (h[i] * h[i]);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double both = f(x + step(i) + step(j)) + f(x - step(i) - step(j));
      const double mixed = 0.5 * (both - plus[i] - minus[i] - plus[j] - minus[j] + 2.0 * out.value);
      out.curvature(i, j) = out.curvature(j, i) = -mixed / (h[i] * h[j]);
    }
  }
  return out;
}

// Away from a peak a curvature may be small or of the wrong sign.
Eigen::MatrixXd Bounded(const Eigen::MatrixXd& curvature) {
  constexpr double kLeastCurvature = 0.1;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(curvature);
  const Eigen::VectorXd values = eigen.eigenvalues().cwiseMax(kLeastCurvature);
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

// Newton's step, the time scale kept within its range and the roots well above zero.
Eigen::VectorXd StepOf(const Quadratic& q, const Eigen::VectorXd& x, double lower, double upper) {
  constexpr double kOfRoot = 0.4, kOfLogarithm = 1.0;
  const Eigen::Index n = x.size();
  const Eigen::MatrixXd H = Bounded(q.curvature);
  Eigen::VectorXd step = H.ldlt().solve(q.slope);
  const double last = std::clamp(x[n - 1] + step[n - 1], lower, upper) - x[n - 1];
  if (last != step[n - 1]) {
    const Eigen::VectorXd slope = q.slope.head(n - 1) - H.col(n - 1).head(n - 1) * last;
    step.head(n - 1) = H.topLeftCorner(n - 1, n - 1).ldlt().solve(slope);
    step[n - 1] = last;
  }
  double share = std::min(1.0, kOfLogarithm / std::max(std::abs(last), 1e-300));
  for (Eigen::Index k = 0; k + 1 < n; ++k)
    share = std::min(share, kOfRoot * x[k] / std::max(std::abs(step[k]), 1e-300));
  return share * step;
}

// Logarithm of the integral over the density at x. Over the amplitudes it is Laplace's. Over the
// time scale it is a quadrature of the density itself, the amplitudes following their peak.
template <class F>
double LogVolume(const F& f, const Quadratic& q, const Eigen::VectorXd& x, double lower,
                 double upper) {
  constexpr double kDeviations = 4.0, kLeastRoot = 0.2;
  const Eigen::Index m = x.size() - 1;
  const Eigen::MatrixXd H = Bounded(q.curvature.topLeftCorner(m, m));
  const Eigen::LDLT<Eigen::MatrixXd> amplitudes(H);
  const Eigen::VectorXd mixed = q.curvature.col(m).head(m);
  const Eigen::VectorXd to = amplitudes.solve(q.slope.head(m)), follow = amplitudes.solve(mixed);
  const double curvature = q.curvature(m, m) - mixed.dot(follow);
  const double width = curvature > 0.0 ? kDeviations / std::sqrt(curvature) : upper - lower;
  const auto along = [&](double log_scale) {
    Eigen::VectorXd at = x;
    at.head(m) += to - follow * (log_scale - x[m]);
    at.head(m) = at.head(m).cwiseMax(kLeastRoot * x.head(m));
    at[m] = log_scale;
    return std::exp(f(at) - q.value);
  };
  const double over_time_scale = boost::math::quadrature::gauss<double, 10>::integrate(
      along, std::max(lower, x[m] - width), std::min(upper, x[m] + width));
  return std::log(over_time_scale) +
         static_cast<double>(m) * 0.5 * std::log(2.0 * std::numbers::pi) -
         0.5 * amplitudes.vectorD().array().log().sum();
}

}  // namespace

NoiseIntegral IntegrateOverNoise(const NoiseModel& begin, const TimeScaleRange& range,
                                 const std::function<double(const NoiseModel&)>& log_density) {
  constexpr int kMostSteps = 8;
  constexpr double kEnough = 0.01;  // nats that another step would gain
  const double lower = std::log(range.shortest), upper = std::log(range.longest);
  const auto f = [&](const Eigen::VectorXd& x) {
    return log_density(NoiseCoordinates::At(x)) + NoiseCoordinates::LogJacobian(x);
  };
  Eigen::VectorXd x = NoiseCoordinates::Of(begin);
  double& log_scale = x[x.size() - 1];
  log_scale = std::clamp(log_scale, lower, upper);
  Quadratic q = QuadraticAt(f, x);
  for (int i = 0; i < kMostSteps; ++i) {
    Eigen::VectorXd step = StepOf(q, x, lower, upper);
    if (q.slope.dot(step) < 2.0 * kEnough) break;
    double value = f(x + step);
    for (int halved = 0; halved < 4 && !(value > q.value); ++halved) value = f(x + (step *= 0.5));
    if (!(value > q.value)) break;
    x += step;
    q = QuadraticAt(f, x);
  }
  return {NoiseCoordinates::At(x),
          LogVolume(f, q, x, lower, upper) + NoiseCoordinates::LogJacobian(x)};
}

}  // namespace hoplab
