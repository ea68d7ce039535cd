#include "tests/support/elastica.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <random>

#include "model/laws/elastica/energy.h"
#include "model/laws/elastica_arc.h"
#include "tests/support/effect_requests.h"

// Law elastica, M61-M63, and what it has beyond M2b, M65.

namespace hoplab {
namespace {

using namespace testing;

// Arcs and loads all over the domain of the tables.
template <class Check>
void OverTheDomain(int count, Check check) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> phi(elastica::kLeastPhi, elastica::kMostPhi),
      load(elastica::kLeastLoad, elastica::kMostLoad);
  for (int i = 0; i < count; ++i) {
    const double arc = phi(random);
    check(arc, load(random) / elastica::LoadScale(arc));
  }
}

TEST(ElasticaTables, GiveChordAndLeadOfThePressedArc) {
  double worst_chord = 0.0, worst_lead = 0.0;
  OverTheDomain(2000, [&](double phi, double f) {
    const elastica::Derivatives<2> G = elastica::EnergyTo2(phi, f);
    const PressedArc exact = SolvePressedArc(phi, 1.0, 1.0, f);
    const double chord = 2.0 * std::sin(0.5 * phi) - f * (2.0 * G[0][0] + f * G[0][1]);
    const double lead = std::cos(0.5 * phi) - f * G[1][0];
    worst_chord = std::max(worst_chord, std::abs(chord - exact.chord) / phi);
    worst_lead = std::max(worst_lead, std::abs(lead - std::cos(exact.end_angle)));
  });
  std::printf("table against shooting: chord %.1e of the arc, u/l %.1e\n", worst_chord, worst_lead);
  EXPECT_LT(worst_chord, 1e-8);
  EXPECT_LT(worst_lead, 1e-8);
}

TEST(ElasticaTables, DerivativesAreThoseOfOneFunction) {
  OverTheDomain(300, [](double phi, double f) {
    const double h = 1e-4;
    const auto at = elastica::EnergyTo3(phi, f);
    const auto ahead = elastica::EnergyTo3(phi + h, f), behind = elastica::EnergyTo3(phi - h, f);
    const auto more = elastica::EnergyTo3(phi, f + h), less = elastica::EnergyTo3(phi, f - h);
    const auto to2 = elastica::EnergyTo2(phi, f);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; i + j < 3; ++j) {
        EXPECT_NEAR((ahead[i][j] - behind[i][j]) / (2 * h), at[i + 1][j],
                    1e-5 * (0.01 + std::abs(at[i + 1][j])));
        EXPECT_NEAR((more[i][j] - less[i][j]) / (2 * h), at[i][j + 1],
                    1e-5 * (0.01 + std::abs(at[i][j + 1])));
        EXPECT_NEAR(to2[i][j], at[i][j], 1e-12);
      }
    }
  });
}

// Curvature of a pressed arc of radius 1, E I = 1, at equal distances from the hip.
constexpr int kArcPoints = 200;
std::array<double, kArcPoints + 1> CurvatureOf(double phi, double f, double length) {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, 2>;  // angle of the tangent, curvature; from the hip
  const double end = SolvePressedArc(phi, 1.0, 1.0, f).end_angle;
  std::array<double, kArcPoints + 1> curvature;
  State s = {0.0, 1.0};
  odeint::runge_kutta_fehlberg78<State> step;
  curvature[0] = 1.0;
  for (int i = 0; i < kArcPoints; ++i) {
    step.do_step(
        [&](const State& q, State& d, double) {
          d = {q[1], f * std::sin(end - q[0])};
        },
        s, 0.0, length / kArcPoints);
    curvature[i + 1] = s[1];
  }
  return curvature;
}

TEST(ElasticaTables, DissipationIsThatOfTheCurvaturesRates) {
  double worst = 0.0;
  OverTheDomain(60, [&](double phi, double f) {
    const double h = 1e-4;
    const auto ahead = CurvatureOf(phi + h, f, phi), behind = CurvatureOf(phi - h, f, phi);
    const auto more = CurvatureOf(phi, f + h, phi), less = CurvatureOf(phi, f - h, phi);
    double ff = 0.0, mixed = 0.0, phiphi = 0.0;
    for (int i = 0; i <= kArcPoints; ++i) {  // Simpson
      const double weight = (i == 0 || i == kArcPoints ? 1.0
                             : i % 2 == 1              ? 4.0
                                                       : 2.0) *
                            phi / (3.0 * kArcPoints);
      const double by_f = (more[i] - less[i]) / (2 * h), by_phi = (ahead[i] - behind[i]) / (2 * h);
      ff += weight * by_f * by_f;
      mixed += weight * by_f * by_phi;
      phiphi += weight * by_phi * by_phi;
    }
    const elastica::Dissipation d = elastica::DissipationAt(phi, f);
    worst = std::max({worst, std::abs(d.ff[0][0] - ff) / (1e-3 + ff),
                      std::abs(d.fphi[0][0] - mixed) / (1e-3 + std::abs(mixed)),
                      std::abs(d.phiphi[0][0] - phiphi) / (1e-3 + phiphi)});
  });
  std::printf("dissipation against differences of the curvature: %.1e\n", worst);
  EXPECT_LT(worst, 1e-5);
}

TEST(Elastica, HigherOrderBendingAtOneTurnsLargeDeflectionIntoIt) {
  for (double theta : {30.0, 8.0, -10.0, -2.0}) {
    SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
    q.parameters.theta_td = Degrees(theta);
    q.initial = {0.0, 0.25, theta == -2.0 ? -0.5 : 0.7, -0.1};
    const std::array effects = {Setting("higher_order_bending", 1.0)};
    q.effects = effects;
    const Trajectory blended = Simulate(q);
    q.effects = {};
    q.law = Law::kElastica;
    const Trajectory exact = Simulate(q);
    ASSERT_EQ(EventNames(blended), EventNames(exact)) << theta;
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(blended.final_state[i], exact.final_state[i], 1e-10) << theta;
  }
}

TEST(Elastica, StaticPressOfARigsLegPrintsWhatTheOtherLawsMiss) {
  // The strip pressed at phi held, by the force that the elastica needs.
  const SimulationRequest q = StripLegRequest(Law::kElastica, Degrees(30.0));
  const double EI = q.parameters.E * q.parameters.I, r = q.parameters.r;
  const LegCompliance<double> c(q.parameters);
  std::printf(
      "error of the deflection at the same force, %%: phi, pressed, large_deflection, elastica\n");
  for (double phi : {2.0, 2.4, 2.8, std::numbers::pi}) {
    for (double f : {0.1, 0.25}) {
      const double F = f * EI / (r * r), rest = 2.0 * r * std::sin(0.5 * phi);
      const double exact = rest - SolvePressedArc(phi, r, EI, F).chord;
      const double bending = c.bending * BendingShape(HalfAngle(phi)).value;
      const double second = F * (bending + F * c.SecondOrder(phi));
      const elastica::Derivatives<2> G = elastica::EnergyTo2(phi, f);
      const double table = r * f * (2.0 * G[0][0] + f * G[0][1]);
      std::printf("%.2f %5.1f %% %8.3f %10.1e\n", phi, 100.0 * exact / rest,
                  100.0 * (second / exact - 1.0), 100.0 * (table / exact - 1.0));
      EXPECT_NEAR(table, exact, 1e-8 * r * phi);
    }
  }
}

}  // namespace
}  // namespace hoplab
