#include "fitting/diagnosis/evidence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace hoplab {
namespace {

constexpr std::array kWidths = {0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0};
constexpr double kAmplitudeScale = 10.0;  // sigma
const double kHalfLogTwoPi = 0.5 * std::log(2.0 * std::numbers::pi);
constexpr double kDifference = 0.05;  // of a logarithm

// Distance from the value that changes nothing, in typical sizes. A parameter of the mechanism that
// may be zero counts from there; one that may not (a modulus) is no surprise at its own size.
double SizeOf(const SharedParameter& s, double value) {
  const bool effect = s.direction.of == SensitivityDirection::Of::kEffect;
  return (value - (effect ? s.initial : 0.0)) / s.scale;
}

bool OneSidedRange(const SharedParameter& s) {
  const bool effect = s.direction.of == SensitivityDirection::Of::kEffect;
  const double null = effect ? s.initial : 0.0;
  return s.lower >= null || s.upper <= null;
}

// log of the integral of exp(-((a + b u)^2 - a^2)/2) over the side of u the bound allows.
double LogHalfSpace(const OneSided& at, bool lower) {
  const double h = at.slope * at.slope;
  if (!(h > 0.0)) return 0.0;
  const double g = (lower ? 1.0 : -1.0) * at.offset * at.slope;  // slope of the cost, inward
  const double z = g / std::sqrt(2.0 * h);
  // sqrt(pi/(2 h)) exp(z^2) erfc(z); its asymptote where exp and erfc leave the range of doubles.
  if (z > 20.0) return -std::log(g);
  const double log_erfc = std::log(boost::math::erfc(z));
  return 0.5 * std::log(std::numbers::pi / (2.0 * h)) + z * z + log_erfc;
}

// Prior densities and Gaussian integrals of the shared values; what lies on bounds by its half
// space.
double LogValues(const FitProblem& problem, const Eigen::VectorXd& shared,
                 const RestrictedLikelihood& likelihood, const std::vector<OneSided>& on_bounds) {
  double sum = likelihood.marginalised() * kHalfLogTwoPi;
  for (int k = 0; k < problem.shared_count(); ++k) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
    sum += LogSizePrior(SizeOf(s, shared[k]), OneSidedRange(s));
  }
  for (const OneSided& at : on_bounds) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(at.parameter)];
    sum += LogHalfSpace(at, shared[at.parameter] <= s.lower + 1e-6 * s.scale);
  }
  return sum;
}

// log of the integral over the noise's own values: their prior, and the Gaussian integral of the
// restricted likelihood's curvature. An amplitude of zero has no logarithm: there the width in
// which a small one would do as well counts, a fifth of sigma.
double LogHyper(const NoiseModel& noise, const RestrictedLikelihood& likelihood) {
  std::vector<std::size_t> active;
  double sum = LogDiscrepancyPrior(noise, likelihood);
  for (std::size_t c = 0; c < noise.amplitude.size(); ++c) {
    if (noise.amplitude[c] > 0.0) active.push_back(c);
  }
  const auto n = static_cast<Eigen::Index>(active.size()) + 1;
  const auto at = [&](const Eigen::VectorXd& x) {
    NoiseModel moved = noise;
    for (std::size_t k = 0; k < active.size(); ++k)
      moved.amplitude[active[k]] *= std::exp(x[static_cast<Eigen::Index>(k)]);
    moved.time_scale *= std::exp(x[n - 1]);
    return likelihood.At(moved) + LogDiscrepancyPrior(moved, likelihood);
  };
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  const double middle = at(zero);
  Eigen::MatrixXd H(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const Eigen::VectorXd ei = kDifference * Eigen::VectorXd::Unit(n, i);
      const Eigen::VectorXd ej = kDifference * Eigen::VectorXd::Unit(n, j);
      const double second = i == j
                                ? at(ei) + at(-ei) - 2.0 * middle
                                : 0.25 * (at(ei + ej) - at(ei - ej) - at(ej - ei) + at(-ei - ej));
      H(i, j) = H(j, i) = -second / (kDifference * kDifference);
    }
  }
  // A time scale at its end has no curvature there: no direction is known better than to a factor
  // of two either way, nor wider than its range.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(H);
  for (Eigen::Index i = 0; i < n; ++i)
    sum += kHalfLogTwoPi - 0.5 * std::log(std::max(eigen.eigenvalues()[i], 1.0));
  return sum;
}

double LogSum(double a, double b) {
  const double most = std::max(a, b);
  return std::isinf(most) ? most : most + std::log(std::exp(a - most) + std::exp(b - most));
}

}  // namespace

double LogSizePrior(double u, bool one_sided) {
  double density = 0.0;
  for (const double w : kWidths)
    density += std::exp(-0.5 * (u / w) * (u / w) - kHalfLogTwoPi) / w / kWidths.size();
  return std::log(std::max(density, 1e-300) * (one_sided ? 2.0 : 1.0));
}

double LogDiscrepancyPrior(const NoiseModel& noise, const RestrictedLikelihood& likelihood) {
  constexpr double kNoneWidth = 0.2;  // sigma
  double sum = -std::log(std::log(likelihood.longest() / likelihood.shortest()));
  for (const double a : noise.amplitude) {
    const double u = (a > 0.0 ? a : kNoneWidth) / kAmplitudeScale;
    sum += std::log(std::sqrt(2.0 / std::numbers::pi) * u) - 0.5 * u * u;
  }
  return sum;
}

double Evidence::log_z() const {
  return LogSum(white + std::log(1.0 - kUnlistedPrior), discrepancy + std::log(kUnlistedPrior));
}

double Evidence::discrepancy_probability() const {
  return std::exp(discrepancy + std::log(kUnlistedPrior) - log_z());
}

Eigen::VectorXd PriorWidths(const FitProblem& problem, const Eigen::VectorXd& shared) {
  constexpr double kLeast = 0.3;
  Eigen::VectorXd widths(problem.shared_count());
  for (int k = 0; k < problem.shared_count(); ++k) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
    widths[k] = std::max(std::abs(SizeOf(s, shared[k])), kLeast);
  }
  return widths;
}

Evidence EvidenceOf(const FitProblem& problem, const Eigen::VectorXd& shared,
                    const RestrictedLikelihood& likelihood, const RestrictedLikelihood& coarse,
                    const NoiseModel& noise) {
  Evidence out;
  std::vector<OneSided> on_bounds;
  const double white = likelihood.At({}, on_bounds);
  out.white = white + LogValues(problem, shared, likelihood, on_bounds);
  out.discrepancy = -std::numeric_limits<double>::infinity();
  if (noise.IsWhite()) return out;
  const double colored = likelihood.At(noise, on_bounds);
  out.discrepancy =
      colored + LogValues(problem, shared, likelihood, on_bounds) + LogHyper(noise, coarse);
  return out;
}

}  // namespace hoplab
