#include "fitting/diagnosis/value_integral.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "fitting/diagnosis/noise_integral.h"

namespace hoplab {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Over one value in pieces between the prior's widths and around `peak`, as a density has them.
template <class F>
double Quadrature(const F& f, double lower, double upper, double peak, double width) {
  std::vector<double> ends = {lower, upper};
  for (const double x : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0}) {
    ends.push_back(x);
    ends.push_back(-x);
  }
  for (double x = -8.0; x <= 8.0; x += 2.0) ends.push_back(peak + x * width);
  for (double& x : ends) x = std::clamp(x, std::max(lower, -300.0), std::min(upper, 300.0));
  std::sort(ends.begin(), ends.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    if (ends[i] > ends[i - 1])
      sum +=
          boost::math::quadrature::gauss_kronrod<double, 15>::integrate(f, ends[i - 1], ends[i], 0);
  }
  return sum;
}

ValueLikelihood OneValue(double root, double rest) {
  ValueLikelihood likelihood;
  likelihood.log_constant = -3.0;
  likelihood.root = Eigen::MatrixXd::Constant(1, 1, root);
  likelihood.rest = Eigen::VectorXd::Constant(1, rest);
  return likelihood;
}

void ExpectQuadrature(double root, double rest, const ValuePrior& prior) {
  const auto log_likelihood = [&](double s) {
    const double r = root * (s - prior.at) + rest;
    return -3.0 - 0.5 * r * r;
  };
  const double peak = prior.at - rest / root;
  // Where its exponential stays within the range of doubles.
  const double most = log_likelihood(std::clamp(peak, prior.lower, prior.upper));
  const auto f = [&](double s) {
    return std::exp(log_likelihood(s) - most + LogSizePrior(s, prior.one_sided));
  };
  const double exact = most + std::log(Quadrature(f, prior.lower, prior.upper, peak, 1.0 / root));
  EXPECT_NEAR(LogValueIntegral(OneValue(root, rest), {prior}), exact, 2e-3)
      << "root " << root << ", rest " << rest << ", at " << prior.at;
}

TEST(LogValueIntegral, OfOneValueIsItsQuadrature) {
  for (const double root : {0.1, 1.0, 10.0, 300.0}) {
    for (const double rest : {-3.0, 0.0, 1.0}) {
      for (const double at : {0.0, 0.05, 2.0})
        ExpectQuadrature(root, rest, {at, -kFar, kFar, false});
    }
  }
}

TEST(LogValueIntegral, OfAValueOnOneSideIsItsQuadrature) {
  // At the bound, near it, and where all of the likelihood lies beyond it.
  for (const double root : {0.1, 1.0, 10.0}) {
    for (const double rest : {-3.0, 0.0, 2.0, 6.0, 40.0}) {
      ExpectQuadrature(root, rest, {0.0, 0.0, 100.0, true});
      ExpectQuadrature(root, rest, {0.2, 0.0, 100.0, true});
      ExpectQuadrature(root, -rest, {0.0, -100.0, 0.0, true});
    }
  }
}

TEST(LogValueIntegral, OfAValueNothingSeesIsThatOfItsPrior) {
  EXPECT_NEAR(LogValueIntegral(OneValue(0.0, 2.0), {{0.7, -kFar, kFar, false}}), -5.0, 1e-3);
  EXPECT_NEAR(LogValueIntegral(OneValue(0.0, 2.0), {{0.7, 0.0, kFar, true}}), -5.0, 1e-3);
}

// Two values, the inner integral done for each outer one.
double LogOfTwo(const ValueLikelihood& l, const std::vector<ValuePrior>& priors) {
  const auto outer = [&](double a) {
    const auto inner = [&](double b) {
      const Eigen::Vector2d u{a - priors[0].at, b - priors[1].at};
      return std::exp(-0.5 * (l.root * u + l.rest).squaredNorm() +
                      LogSizePrior(a, priors[0].one_sided) + LogSizePrior(b, priors[1].one_sided));
    };
    const Eigen::VectorXd column = l.root.col(1);
    const Eigen::VectorXd rest =
        l.rest + l.root.col(0) * (a - priors[0].at) - column * priors[1].at;
    const double peak = -column.dot(rest) / column.squaredNorm();
    return Quadrature(inner, priors[1].lower, priors[1].upper, peak, 1.0 / column.norm());
  };
  // The outer integrand is as narrow as the first value alone is known.
  const Eigen::Vector2d best = l.root.completeOrthogonalDecomposition().solve(-l.rest);
  return std::log(Quadrature(outer, priors[0].lower, priors[0].upper, priors[0].at + best[0],
                             1.0 / l.root.col(0).norm()));
}

TEST(LogValueIntegral, OfTwoThatLookAlikeIsTheirDoubleIntegral) {
  ValueLikelihood l;
  l.rest = Eigen::Vector2d{0.3, -0.2};
  const std::vector<ValuePrior> free = {{1.0, -kFar, kFar, false}, {0.5, -kFar, kFar, false}};
  const std::vector<ValuePrior> half = {{1.0, -kFar, kFar, false}, {0.0, 0.0, 100.0, true}};
  for (const double apart : {5.0, 0.5, 0.0}) {
    l.root = Eigen::Matrix2d{{8.0, 7.5}, {0.0, apart}};
    EXPECT_NEAR(LogValueIntegral(l, free), LogOfTwo(l, free), 0.01) << apart;
    EXPECT_NEAR(LogValueIntegral(l, half), LogOfTwo(l, half), 0.05) << apart;
  }
}

// Both cut, and correlated: each is cut in turn, which is not exact.
TEST(LogValueIntegral, OfTwoOnTheirBoundsIsNearTheirDoubleIntegral) {
  ValueLikelihood l;
  l.rest = Eigen::Vector2d{0.5, 0.5};
  const std::vector<ValuePrior> both = {{0.0, 0.0, 100.0, true}, {0.0, 0.0, 100.0, true}};
  for (const double apart : {5.0, 1.0, 0.0}) {
    l.root = Eigen::Matrix2d{{4.0, 3.0}, {0.0, apart}};
    EXPECT_NEAR(LogValueIntegral(l, both), LogOfTwo(l, both), 0.1) << apart;
    l.root(0, 1) = -3.0;
    EXPECT_NEAR(LogValueIntegral(l, both), LogOfTwo(l, both), 0.1) << -apart;
  }
}

// ---- the noise's own values

// Laplace's method is held to a third of what the evidence is held to [nats].
constexpr double kLaplace = 0.1;

// A normal density of the logarithms, its peak at these: not quite one of the coordinates that the
// integral is taken in.
struct LogNormalNoise {
  Eigen::Vector3d peak;
  Eigen::Matrix3d precision{{4.0, 1.0, -1.5}, {1.0, 3.0, 0.5}, {-1.5, 0.5, 5.0}};

  double operator()(const NoiseModel& noise) const {
    const Eigen::Vector3d off =
        Eigen::Vector3d{std::log(noise.amplitude[0]), std::log(noise.amplitude[1]),
                        std::log(noise.time_scale)} -
        peak;
    return 7.0 - 0.5 * off.dot(precision * off);
  }
  double LogIntegral(const TimeScaleRange& range) const {
    const double variance = precision.inverse()(2, 2);
    const boost::math::normal of_scale(peak[2], std::sqrt(variance));
    return 7.0 + 1.5 * std::log(2.0 * std::numbers::pi) - 0.5 * std::log(precision.determinant()) +
           std::log(boost::math::cdf(of_scale, std::log(range.longest)) -
                    boost::math::cdf(of_scale, std::log(range.shortest)));
  }
};

TEST(IntegrateOverNoise, IsThatOfALogNormalDensityWhereverItsPeakLies) {
  const TimeScaleRange range = {0.02, 0.5};
  const NoiseModel begin{{0.5, 3.0}, 0.4};
  // Inside, at an end of the time scales, and beyond either.
  for (const double scale : {0.1, 0.5, 0.9, 0.01}) {
    const LogNormalNoise density{{std::log(1.5), std::log(0.8), std::log(scale)}};
    const NoiseIntegral found = IntegrateOverNoise(begin, range, density);
    EXPECT_NEAR(density(found.peak) + found.log_volume, density.LogIntegral(range), kLaplace)
        << scale;
    EXPECT_GE(found.peak.time_scale, range.shortest * (1.0 - 1e-12));
    EXPECT_LE(found.peak.time_scale, range.longest * (1.0 + 1e-12));
  }
}

// An amplitude whose likelihood falls from zero on: its density per logarithm is a exp(-a^2/(2
// s^2)).
TEST(IntegrateOverNoise, CountsTheWidthOfAnAmplitudeThatMayBeZero) {
  const TimeScaleRange range = {0.1, 0.5};
  for (const double s : {0.05, 0.3, 2.0}) {
    const auto density = [s](const NoiseModel& noise) {
      const double a = noise.amplitude[0] / s;
      return std::log(noise.amplitude[0]) - 0.5 * a * a;
    };
    const NoiseIntegral found = IntegrateOverNoise({{0.0}, 0.2}, range, density);
    const double exact = std::log(s * std::sqrt(0.5 * std::numbers::pi)) + std::log(std::log(5.0));
    EXPECT_NEAR(density(found.peak) + found.log_volume, exact, kLaplace) << s;
  }
}

}  // namespace
}  // namespace hoplab
