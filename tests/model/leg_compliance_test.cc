#include "model/leg_compliance.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <numbers>
#include <vector>

#include "tests/support/elastica.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;
using Real = boost::multiprecision::cpp_dec_float_100;

// From 1e-3 to pi, dense around the angles where the code changes formula (0.1, 1, 1.5).
std::vector<double> ArcGrid() {
  std::vector<double> grid;
  for (double phi = 1e-3; phi < std::numbers::pi; phi *= 1.15) grid.push_back(phi);
  for (double at : {0.1, 1.0, 1.5})
    for (double off : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3}) grid.push_back(at + off);
  grid.push_back(std::numbers::pi);
  return grid;
}

// Integral over the arc of a cross-section quantity squared or multiplied, per unit chord force
// and unit radius: a = phi/2 - gamma runs over the arc.
template <class Integrand>
Real OverArc(const Real& phi, const Integrand& integrand) {
  // 61 points are exact to 1e-30 for these smooth integrands on an arc below pi.
  return boost::math::quadrature::gauss<Real, 30>::integrate(
      [&](const Real& a) { return integrand(a, phi); }, Real(-phi / 2), Real(phi / 2));
}

// Castigliano for a curved bar (bending, normal force with its coupling to bending, shear):
// twice the strain energy per unit chord force. In units where f of M1 etc. are its halves.
Real BendingByQuadrature(const Real& phi) {
  return 2 * OverArc(phi, [](const Real& a, const Real& p) {
           const Real arm = cos(a) - cos(p / 2);
           return Real(arm * arm);
         });
}
Real AxialByQuadrature(const Real& phi) {
  return 2 * OverArc(phi, [](const Real& a, const Real& p) {
           const Real arm = cos(a) - cos(p / 2);
           return Real(cos(a) * cos(a) - 2 * arm * cos(a));
         });
}
Real ShearByQuadrature(const Real& phi) {
  return 2 * OverArc(phi, [](const Real& a, const Real&) { return Real(sin(a) * sin(a)); });
}
// M2b as printed, in 100 digits.
Real SecondOrderInManyDigits(const Real& phi) {
  const Real S = sin(phi / 2), K = cos(phi / 2);
  return Real(3) / 4 * phi * phi * S * K * K + Real(9) / 2 * phi * K * K * K -
         Real(3) / 4 * phi * K - Real(17) / 2 * S * K * K + S;
}

// First and second derivative by differences in 100 digits: steps of 1e-15 leave 1e-28.
template <class Function>
std::array<Real, 3> WithDerivatives(const Function& f, double at) {
  const Real phi(at), h = phi * Real("1e-15");
  const Real up = f(phi + h), mid = f(phi), down = f(phi - h);
  return {mid, (up - down) / (2 * h), (up - 2 * mid + down) / (h * h)};
}

double ErrorOf(double value, const Real& exact) {
  return static_cast<double>(abs((Real(value) - exact) / exact));
}
// Where a function passes through zero, relative to its value on the scale `size`.
double ErrorOf(double value, const Real& exact, double size) {
  return static_cast<double>(abs(Real(value) - exact)) / size;
}

TEST(LegCompliance, BendingShapeAndDerivativesMatchQuadrature) {
  for (double phi : ArcGrid()) {
    const ShapeValue s = BendingShape(HalfAngle(phi));
    const auto exact = WithDerivatives(BendingByQuadrature, phi);
    EXPECT_LT(ErrorOf(s.value, exact[0]), kClosedForm) << phi;
    EXPECT_LT(ErrorOf(s.d1, exact[1]), kClosedForm) << phi;
    EXPECT_LT(ErrorOf(s.d2, exact[2]), kClosedForm) << phi;
  }
}

TEST(LegCompliance, AxialShapeAndDerivativesMatchQuadrature) {
  for (double phi : ArcGrid()) {
    // 3 sin phi - phi changes sign at 2.28, its derivatives at 1.23 and pi: sizes near phi.
    const double size = std::min(phi, 1.0);
    const ShapeValue s = AxialShape(HalfAngle(phi));
    const auto exact = WithDerivatives(AxialByQuadrature, phi);
    EXPECT_LT(ErrorOf(s.value, exact[0], size), kClosedForm) << phi;
    EXPECT_LT(ErrorOf(s.d1, exact[1], 1.0), kClosedForm) << phi;
    EXPECT_LT(ErrorOf(s.d2, exact[2], size), kClosedForm) << phi;
  }
}

TEST(LegCompliance, ShearShapeAndDerivativesMatchQuadrature) {
  for (double phi : ArcGrid()) {
    const ShapeValue s = ShearShape(HalfAngle(phi));
    const auto exact = WithDerivatives(ShearByQuadrature, phi);
    EXPECT_LT(ErrorOf(s.value, exact[0]), kClosedForm) << phi;
    EXPECT_LT(ErrorOf(s.d1, exact[1]), kClosedForm) << phi;
    EXPECT_LT(ErrorOf(s.d2, exact[2], std::min(phi, 1.0)), kClosedForm) << phi;  // 0 at pi
  }
}

TEST(LegCompliance, SecondOrderShapeAndDerivativesMatchTheClosedFormInManyDigits) {
  for (double phi : ArcGrid()) {
    const ShapeValue s = SecondOrderShape(HalfAngle(phi));
    const auto exact = WithDerivatives(SecondOrderInManyDigits, phi);
    EXPECT_LT(ErrorOf(s.value, exact[0]), kClosedForm) << phi;
    EXPECT_LT(ErrorOf(s.d1, exact[1]), kClosedForm) << phi;
    EXPECT_LT(ErrorOf(s.d2, exact[2], std::pow(std::min(phi, 1.0), 5)), kClosedForm) << phi;
  }
}

TEST(LegCompliance, ChordComplianceOfARealLegMatchesQuadrature) {
  const Parameters<double> p = ThickLegRequest(Law::kConsistent).parameters;
  const LegCompliance<double> c(p);
  for (double phi : ArcGrid()) {
    const double exact =
        0.5 * (p.r * p.r * p.r / (p.E * p.I) * static_cast<double>(BendingByQuadrature(phi)) +
               p.r / (p.E * p.A) * static_cast<double>(AxialByQuadrature(phi)) +
               p.kappa * p.r / (p.G * p.A) * static_cast<double>(ShearByQuadrature(phi)));
    EXPECT_LT(RelativeError(c.Chord(phi), exact), kClosedForm) << phi;
  }
}

TEST(LegCompliance, SecondOrderComplianceIsPositiveUpToAHalfCircle) {
  for (double phi = 1e-3; phi <= std::numbers::pi; phi += 1e-3)
    EXPECT_GT(SecondOrderShape(HalfAngle(phi)).value, 0.0) << phi;
}

// How far the expansion M9b, M10b is from the exact elastica at a load. `euler` is the load over
// that at which a straight rod of the same length buckles: what governs the error of every arc.
struct ExpansionError {
  double chord;             // over F C
  double tip;               // of u/l
  double deflection_ratio;  // F C/l0
};
ExpansionError ErrorAt(double phi, double euler, bool second_order) {
  Parameters<double> p;
  p.r = 0.09;
  p.E = 22e9;
  p.I = 1.2e-10;
  p.A = 1e9;  // no normal or shear strain, as in the elastica
  p.G = 1e12;
  const LegCompliance<double> c(p);
  const HalfAngle h(phi);
  const ShapeValue b = BendingShape(h), a = AxialShape(h), s = ShearShape(h),
                   g = SecondOrderShape(h);
  const double C = c.Chord(b, a, s), dC = c.ChordD1(b, a, s) / p.r;
  const double C2 = second_order ? c.second_order * g.value : 0.0;
  const double dC2 = second_order ? c.second_order * g.d1 / p.r : 0.0;
  const double l0 = 2.0 * p.r * h.sin;
  const double F = euler * p.E * p.I * std::pow(std::numbers::pi / (p.r * phi), 2);
  const PressedArc exact = SolvePressedArc(phi, p.r, p.E * p.I, F);
  return {(exact.chord - (l0 - F * C - F * F * C2)) / (F * C),
          std::cos(exact.end_angle) - (h.cos - 0.5 * F * dC - F * F * dC2 / 3.0), F * C / l0};
}

TEST(LegCompliance, UnloadedElasticaIsTheArc) {
  const PressedArc arc = SolvePressedArc(2.5, 0.09, 2.6, 0.0);
  EXPECT_NEAR(arc.chord, 0.18 * std::sin(1.25), 1e-15);
  EXPECT_NEAR(arc.end_angle, 1.25, 1e-14);
}

// Order p of an error that behaves like load^p, from two loads a factor 2 apart.
double Order(double at_2x, double at_x) { return std::log2(std::abs(at_2x / at_x)); }

TEST(LegCompliance, ExpansionWithM2bMissesTheElasticaByThirdOrderInTheLoad) {
  for (double phi : {1.5, 2.0, 2.4, 2.8, std::numbers::pi}) {
    const ExpansionError coarse = ErrorAt(phi, 2e-3, true), fine = ErrorAt(phi, 1e-3, true);
    // The chord error is over F C, so one order lower. The next term is a few per mille.
    EXPECT_NEAR(1.0 + Order(coarse.chord, fine.chord), 3.0, 0.03) << phi;
    EXPECT_NEAR(Order(coarse.tip, fine.tip), 3.0, 0.03) << phi;
  }
}

TEST(LegCompliance, ExpansionWithoutM2bMissesTheElasticaBySecondOrderInTheLoad) {
  for (double phi : {1.5, 2.0, 2.4, 2.8, std::numbers::pi}) {
    const ExpansionError coarse = ErrorAt(phi, 2e-3, false), fine = ErrorAt(phi, 1e-3, false);
    EXPECT_NEAR(1.0 + Order(coarse.chord, fine.chord), 2.0, 0.03) << phi;
    EXPECT_NEAR(Order(coarse.tip, fine.tip), 2.0, 0.03) << phi;
  }
}

TEST(LegCompliance, M2bHalvesTheErrorUpToAFifthOfTheEulerLoad) {
  std::printf(
      " phi  F/F_euler  F C/l0 | chord error/(F C): with M2b, without | error of u/l: with,"
      " without\n");
  for (double phi : {1.5, 2.0, 2.5, 3.0, std::numbers::pi}) {
    for (double euler : {0.05, 0.1, 0.2, 0.3, 0.5}) {
      const ExpansionError two = ErrorAt(phi, euler, true), one = ErrorAt(phi, euler, false);
      std::printf("%.2f    %.2f      %.3f  |  %8.4f  %8.4f  |  %8.4f  %8.4f\n", phi, euler,
                  two.deflection_ratio, two.chord, one.chord, two.tip, one.tip);
      if (euler > 0.2) continue;
      EXPECT_LT(std::abs(two.chord), 0.5 * std::abs(one.chord)) << phi << ' ' << euler;
      EXPECT_LT(std::abs(two.tip), 0.5 * std::abs(one.tip)) << phi << ' ' << euler;
    }
  }
}

}  // namespace
}  // namespace hoplab
