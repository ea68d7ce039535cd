// A hip torque that bends the leg (M24, M25), against Castigliano's integral and the elastica.
#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <numbers>

#include "model/laws/extended_leg.h"
#include "model/leg_compliance.h"
#include "tests/support/elastica.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;

// A stiff strip without normal and shear strain, as in the elastica.
Parameters<double> Rod() {
  Parameters<double> p;
  p.r = 0.09;
  p.E = 22e9;
  p.I = 1.2e-10;
  p.A = 1e9;
  p.G = 1e12;
  return p;
}

// Chord and lead u/l of a leg with M24 and M25 on an arc phi under F and N, by their definition.
struct Bent {
  double chord, lead;
};
Bent Expansion(const Parameters<double>& p, double phi, double F, double N) {
  const HalfAngle h(phi);
  const LegCompliance<double> c(p);
  const ShapeValue b = BendingShape(h), g = SecondOrderShape(h);
  const double D = c.bending * b.d1, B = c.bending * b.d2 / (2.0 * p.r);
  return {2.0 * p.r * h.sin - F * c.bending * b.value - F * F * c.second_order * g.value - N * D,
          h.cos - 0.5 * F * c.bending * b.d1 / p.r - F * F * c.second_order * g.d1 / (3.0 * p.r) -
              N * B};
}

TEST(TorqueBending, CrossComplianceIsCastiglianosIntegral) {
  const auto over_arc = [](double phi, const auto& f) {
    return boost::math::quadrature::gauss<double, 30>::integrate(f, -0.5 * phi, 0.5 * phi);
  };
  for (double phi : {0.3, 0.8, 1.2, 1.7, 2.3, 2.8, std::numbers::pi}) {
    const double S = std::sin(0.5 * phi), K = std::cos(0.5 * phi);
    // Moments per unit force and radius: of F, of N, of a couple on the tip.
    const auto press = [&](double a) { return std::cos(a) - K; };
    const auto across = [&](double a) { return S - std::sin(a); };
    const auto couple = [&](double a) { return (S + std::sin(a)) / (2.0 * S); };
    const ShapeValue b = BendingShape(HalfAngle(phi));
    // D = r^3/(E I) int press across = r^3/(2 E I) f'.
    EXPECT_LT(
        RelativeError(0.5 * b.d1, over_arc(phi, [&](double a) { return press(a) * across(a); })),
        1e-11)
        << phi;
    // B = sin(phi/2) r^2/(E I) int across couple = r^2/(4 E I) f''.
    EXPECT_LT(RelativeError(0.25 * b.d2,
                            S * over_arc(phi, [&](double a) { return across(a) * couple(a); })),
              1e-11)
        << phi;
  }
}

TEST(TorqueBending, HeldArcWithoutAForceAcrossIsThePressedArc) {
  const PressedArc pressed = SolvePressedArc(2.5, 0.09, 2.6, 30.0);
  const PressedArc held = SolveHeldArc(2.5, 0.09, 2.6, 30.0, 0.0);
  EXPECT_NEAR(held.chord, pressed.chord, 1e-13);
  EXPECT_NEAR(held.end_angle, pressed.end_angle, 1e-12);
}

TEST(TorqueBending, MissesTheElasticaBySecondOrderInTheLoad) {
  const Parameters<double> p = Rod();
  for (double phi : {1.5, 2.0, 2.5, std::numbers::pi}) {
    for (double share : {-0.5, 0.3, 1.0}) {  // N/F
      const auto error = [&](double euler) {
        const double F = euler * p.E * p.I * std::pow(std::numbers::pi / (p.r * phi), 2);
        const PressedArc exact = SolveHeldArc(phi, p.r, p.E * p.I, F, share * F);
        const Bent bent = Expansion(p, phi, F, share * F);
        return Bent{exact.chord - bent.chord, std::cos(exact.end_angle) - bent.lead};
      };
      const Bent coarse = error(2e-3), fine = error(1e-3);
      EXPECT_NEAR(std::log2(std::abs(coarse.chord / fine.chord)), 2.0, 0.1) << phi << ' ' << share;
      EXPECT_NEAR(std::log2(std::abs(coarse.lead / fine.lead)), 2.0, 0.1) << phi << ' ' << share;
    }
  }
}

// A leg that stands under torque, against the elastica under the forces it claims: what is off in
// the chord force, relative, and in the arc.
struct Miss {
  double force, arc;
};
Miss MissOfTheElastica(Law law, double phi, double euler, double share) {
  Parameters<double> p = Rod();
  p.law_terms.active = p.law_terms.torque_active = true;
  p.law_terms.torque_bending = 1.0;
  const double F = euler * p.E * p.I * std::pow(std::numbers::pi / (p.r * phi), 2);
  const PressedArc exact = SolveHeldArc(phi, p.r, p.E * p.I, F, share * F);
  const double u = exact.chord * std::cos(exact.end_angle);
  const double y = exact.chord * std::sin(exact.end_angle);
  const std::array<double, 5> z = {0.0, y, 0.0, 0.0, u - p.r * phi};
  ExtendedLeg<double> leg(p, law);
  leg.StartRootAt(phi - 0.01);
  const auto load = leg.Load(Mode::kRolling, z.data(), {0.0, share * F * exact.chord});
  return {load.elastic_force / F - 1.0, load.phi - phi};
}

TEST(TorqueBending, LegUnderTorqueIsTheElasticaToSecondOrder) {
  // With M24b and M25b; `consistent` has the first order alone.
  for (double phi : {1.6, 2.2, 2.8}) {
    for (double share : {-0.3, 0.3, 1.0}) {
      const Miss coarse = MissOfTheElastica(Law::kLargeDeflection, phi, 4e-3, share);
      const Miss fine = MissOfTheElastica(Law::kLargeDeflection, phi, 2e-3, share);
      // At least: the leading error passes through zero between these shares.
      EXPECT_GT(std::log2(std::abs(coarse.force / fine.force)), 1.9) << phi << ' ' << share;
      EXPECT_GT(std::log2(std::abs(coarse.arc / fine.arc)), 2.9) << phi << ' ' << share;
      const Miss first_coarse = MissOfTheElastica(Law::kConsistent, phi, 4e-3, share);
      const Miss first = MissOfTheElastica(Law::kConsistent, phi, 2e-3, share);
      EXPECT_NEAR(std::log2(first_coarse.force / first.force), 1.0, 0.1) << phi << ' ' << share;
      EXPECT_NEAR(std::log2(first_coarse.arc / first.arc), 2.0, 0.1) << phi << ' ' << share;
    }
  }
}

}  // namespace
}  // namespace hoplab
