#include "fitting/diagnosis/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fitting/diagnosis/noise_integral.h"

namespace hoplab {
namespace {

constexpr double kAmplitudeScale = 10.0;  // sigma

// The value that changes nothing. A parameter of the mechanism that may be zero counts from there;
// one that may not (a modulus) is no surprise at its own size. A scale or an offset of a sensor
// counts from what is stated.
double NullOf(const SharedParameter& s) {
  return s.direction.of == SensitivityDirection::Of::kParameter ? 0.0 : s.initial;
}

// Distance from it, in typical sizes.
double SizeOf(const SharedParameter& s, double value) { return (value - NullOf(s)) / s.scale; }

bool OneSidedRange(const SharedParameter& s) {
  return s.lower >= NullOf(s) || s.upper <= NullOf(s);
}

std::vector<ValuePrior> PriorsOf(const FitProblem& problem, const Eigen::VectorXd& shared) {
  std::vector<ValuePrior> priors;
  for (int k = 0; k < problem.shared_count(); ++k) {
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(k)];
    priors.push_back(
        {SizeOf(s, shared[k]), SizeOf(s, s.lower), SizeOf(s, s.upper), OneSidedRange(s)});
  }
  return priors;
}

double LogSum(double a, double b) {
  const double most = std::max(a, b);
  return std::isinf(most) ? most : most + std::log(std::exp(a - most) + std::exp(b - most));
}

}  // namespace

double LogDiscrepancyPrior(const NoiseModel& noise, const RestrictedLikelihood& likelihood) {
  double sum = -std::log(std::log(likelihood.longest() / likelihood.shortest()));
  for (const double a : noise.amplitude) {
    const double u = a / kAmplitudeScale;
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
  const std::vector<ValuePrior> priors = PriorsOf(problem, shared);
  out.white = LogValueIntegral(likelihood.ValuesAt({}), priors);
  out.discrepancy = -std::numeric_limits<double>::infinity();
  if (noise.IsWhite()) return out;
  const auto at = [&](const RestrictedLikelihood& of, const NoiseModel& n) {
    return LogValueIntegral(of.ValuesAt(n), priors) + LogDiscrepancyPrior(n, likelihood);
  };
  const NoiseIntegral integral =
      IntegrateOverNoise(noise, {likelihood.shortest(), likelihood.longest()},
                         [&](const NoiseModel& n) { return at(coarse, n); });
  out.discrepancy = at(likelihood, integral.peak) + integral.log_volume;
  return out;
}

}  // namespace hoplab
