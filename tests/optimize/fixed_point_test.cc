// Fixed points and multipliers against published values, and against differences of the map alone.
#include "optimize/fixed_point.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

#include "base/random.h"
#include "optimize/apex_map.h"
#include "optimize/continuation.h"
#include "optimize/convergence_time.h"
#include "tests/support/controlled_hopper.h"
#include "tests/support/requests.h"
#include "tests/support/richardson.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

const ApexState kSlip(0.513806075894484, 1.238312718076982);

FixedPoint SlipFrom(const ApexState& start) {
  ApexMap map({SteadyStraightLeg(), {}});
  FixedPointOptions options;
  options.specific_energy = map.SpecificEnergy(kSlip);  // fixed points are a family over energy
  return SearchFixedPoint(map, start, options);
}

TEST(ReturnMap, IsThatOfAPlacedLegWhateverItsStart) {
  Hopper hopper = ControlledHopper();
  const Hop placed = ApexMap(hopper).Apply(ApexState(1.0, 0.3));
  hopper.request.parameters.start_angle = 0.3;  // M47
  const Hop other = ApexMap(hopper).Apply(ApexState(1.0, 0.3));
  ASSERT_TRUE(placed.ok());
  EXPECT_EQ(placed.next, other.next);
}

TEST(FixedPoint, KnownSteadyHopIsFoundFromTenPercentOff) {
  for (const double vx : {0.9, 1.1}) {
    for (const double y : {0.9, 1.1}) {
      const FixedPoint point = SlipFrom(ApexState(vx * kSlip[0], y * kSlip[1]));
      ASSERT_TRUE(point.found()) << vx << ' ' << y;
      EXPECT_TRUE(point.conserves_energy);
      EXPECT_NEAR(point.state[0], kSlip[0], 1e-9);
      EXPECT_NEAR(point.state[1], kSlip[1], 1e-9);
    }
  }
}

TEST(FixedPoint, MultipliersOfTheKnownSteadyHopAreAsPublished) {
  const FixedPoint point = SlipFrom(ApexState(0.9 * kSlip[0], 1.1 * kSlip[1]));
  ASSERT_TRUE(point.found());
  EXPECT_NEAR(point.multipliers[0].real(), 4.180741, 1e-6);
  EXPECT_NEAR(point.multipliers[1].real(), 1.0, 1e-6);
  EXPECT_EQ(point.multipliers[0].imag(), 0.0);
  EXPECT_FALSE(point.stable());
}

TEST(FixedPoint, AHopThatFallsIsNamed) {
  ApexMap map({SteadyStraightLeg(), {}});
  const FixedPoint point = FindFixedPoint(map, ApexState(0.5, 0.3));
  EXPECT_EQ(point.status, FixedPointStatus::kHopFails);
  EXPECT_EQ(point.hop.outcome, Outcome::kStartsInGround);
  EXPECT_TRUE(std::isnan(point.spectral_radius));
}

TEST(ReturnMap, ItsDerivativesAreThoseOfTheMap) {
  Hopper hopper = ControlledHopper();
  ApexMap map(hopper);
  const std::array parameters = {D::Parameter(ParameterId::kKp), D::Parameter(ParameterId::kE),
                                 D::Parameter(ParameterId::kThetaTd)};
  const ApexState z(1.2, 0.3);
  const Hop hop = map.Differentiate(z, parameters);
  ASSERT_TRUE(hop.ok());
  const auto as_vector = [](const ApexState& s) { return std::vector<double>{s[0], s[1]}; };
  const auto expect_column = [&](const Eigen::Vector2d& column, const DifferenceColumn& oracle) {
    const double size = column.norm();
    EXPECT_LT(oracle.error_norm, kGradientOracle * size);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(column[i], oracle.value[i], kGradient * size);
  };
  for (int k = 0; k < 2; ++k) {
    const auto moved = [&](double value) {
      ApexState s = z;
      s[k] = value;
      return as_vector(map.Apply(s).next);
    };
    expect_column(hop.jacobian.col(k), RichardsonDerivative(moved, z[k], 0.01));
  }
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double value = ValueOf(hopper, parameters[p]);
    const auto moved = [&](double v) {
      SetValue(map.hopper(), parameters[p], v);
      const ApexState next = map.Apply(z).next;
      SetValue(map.hopper(), parameters[p], value);
      return as_vector(next);
    };
    expect_column(hop.by_parameter.col(static_cast<int>(p)),
                  RichardsonDerivative(moved, value, 0.02 * value));
  }
}

// Spectral radius from the map alone: its Jacobian by differences, its fixed point by Newton's
// method with that Jacobian. Shares nothing with the sensitivities.
double SpectralRadiusByDifferences(Hopper hopper, ApexState z) {
  ApexMap map(std::move(hopper));
  Eigen::Matrix2d J;
  for (int iteration = 0; iteration < 8; ++iteration) {
    for (int k = 0; k < 2; ++k) {
      const auto moved = [&](double value) {
        ApexState s = z;
        s[k] = value;
        const ApexState next = map.Apply(s).next;
        return std::vector<double>{next[0], next[1]};
      };
      const DifferenceColumn column = RichardsonDerivative(moved, z[k], 0.01);
      J.col(k) << column.value[0], column.value[1];
    }
    z += (Eigen::Matrix2d::Identity() - J).inverse() * (map.Apply(z).next - z);
  }
  return J.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(SpectralRadius, ItsDerivativesAgreeWithDifferencesOfTheMapAlone) {
  const Hopper hopper = ControlledHopper();
  ApexMap map(hopper);
  const FixedPoint point = SearchFixedPoint(map, ApexState(1.2, 0.3));
  ASSERT_TRUE(point.found());
  EXPECT_NEAR(SpectralRadiusByDifferences(hopper, point.state), point.spectral_radius, 1e-8);
  for (const ParameterId id : {ParameterId::kKp, ParameterId::kThetaTd, ParameterId::kE,
                               ParameterId::kD, ParameterId::kVDes, ParameterId::kM}) {
    const D direction = D::Parameter(id);
    const SpectralRadiusRate rate = DifferentiateSpectralRadius(map, point, direction);
    const double value = ValueOf(hopper, direction);
    const auto radius = [&](double v) {
      Hopper moved = hopper;
      SetValue(moved, direction, v);
      return std::vector<double>{SpectralRadiusByDifferences(std::move(moved), point.state)};
    };
    const DifferenceColumn oracle = RichardsonDerivative(radius, value, 0.01 * value);
    EXPECT_NEAR(rate.value / oracle.value[0], 1.0, 1e-5) << InfoOf(id).name;
    EXPECT_LT(rate.error, 1e-5 * std::abs(rate.value)) << InfoOf(id).name;
    std::printf("  d rho/d %-8.*s %+.9e  relative to differences %+.1e  own error %.1e\n",
                static_cast<int>(InfoOf(id).name.size()), InfoOf(id).name.data(), rate.value,
                rate.value / oracle.value[0] - 1.0, std::abs(rate.error / rate.value));
  }
}

TEST(SpectralRadius, AtZeroDampingItsDerivativeIsOneSided) {
  Hopper hopper = ControlledHopper();
  const D damping = D::Parameter(ParameterId::kD);
  const auto rate_at = [&](double d) {
    SetValue(hopper, damping, d);
    ApexMap map(hopper);
    return DifferentiateSpectralRadius(map, SearchFixedPoint(map, ApexState(1.0, 0.3)), damping);
  };
  // From the other side: values at small damping, extrapolated to none.
  const double extrapolated = 2.0 * rate_at(0.02).value - rate_at(0.04).value;
  const SpectralRadiusRate at_zero = rate_at(0.0);
  EXPECT_NEAR(at_zero.value / extrapolated, 1.0, 1e-3);
  EXPECT_LT(at_zero.error, 1e-5 * std::abs(at_zero.value));
}

}  // namespace
}  // namespace hoplab
