#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "model/laws/extended_statics.h"
#include "tests/support/effect_requests.h"
#include "tests/support/standing_strip.h"

// A leg whose rest curvature changes along its arc, M124.

namespace hoplab {
namespace {

using namespace testing;

Statics<double> StaticsOfUneven(Law law, double phi, double chord, double chi) {
  Parameters<double> p;
  p.r = p.E = p.I = 1.0;
  p.A = p.G = 1e12;
  p.law_terms.active = p.law_terms.uneven_active = true;
  p.law_terms.uneven = chi;
  return StaticsAt<double, double>(p, law, 0.0, {phi, chord, 1.0});
}

constexpr double kArcsInUse[] = {0.6, 1.2, 2.0, 2.8, std::numbers::pi};

// To first order in chi: differences of the strip's own, forward and back, leave the third.
TEST(UnevenCurvature, IsThatOfTheStripToFirstOrder) {
  constexpr double chi = 1e-3;
  for (const double phi : kArcsInUse) {
    for (const double f : {0.0, 0.05, 0.2, 0.3}) {
      const StandingStrip more(phi, f, 0.0, chi), less(phi, f, 0.0, -chi);
      const double by_chi = (more.chord - less.chord) / (2.0 * chi);
      const double lead_by_chi = (more.lead - less.lead) / (2.0 * chi);
      // The chord at which the law has the load f, and its lead there.
      const auto law_at = [&](double c) {
        double chord = StandingStrip(phi, f, 0.0).chord;
        for (int round = 0; round < 8; ++round) {
          const double F = StaticsOfUneven(Law::kElastica, phi, chord, c).F;
          const double slope = StaticsOfUneven(Law::kElastica, phi, chord + 1e-6, c).F - F;
          chord -= (F - f) * 1e-6 / slope;
        }
        return std::array{chord, -StaticsOfUneven(Law::kElastica, phi, chord, c).tip_turn};
      };
      const auto up = law_at(chi), down = law_at(-chi);
      // What is left goes with the load's square: C2's share is lambda^3.
      EXPECT_NEAR((up[0] - down[0]) / (2.0 * chi), by_chi, 1e-5 + 0.5 * f * f) << phi << ' ' << f;
      EXPECT_NEAR((up[1] - down[1]) / (2.0 * chi), lead_by_chi, 1e-5 + 0.5 * f * f)
          << phi << ' ' << f;
      std::printf("%.2f %.2f: %+.5f %+.5f; %+.5f %+.5f\n", phi, f, (up[0] - down[0]) / (2.0 * chi),
                  by_chi, (up[1] - down[1]) / (2.0 * chi), lead_by_chi);
    }
  }
}

// What is left of a leg that is far from a circle, against what the law would miss without M124.
TEST(UnevenCurvature, LargeOnesAreNearlyThoseOfTheStrip) {
  std::printf("chi, phi, f: chord's force over the exact one - 1, lead off; without M124\n");
  for (const double chi : {-0.05, 0.05, 0.15}) {
    for (const double phi : {1.6, 2.2, 2.8, std::numbers::pi}) {
      for (const double f : {0.1, 0.3}) {
        const StandingStrip exact(phi, f, 0.0, chi);
        const Statics<double> at = StaticsOfUneven(Law::kElastica, phi, exact.chord, chi);
        const Statics<double> even = StaticsOfUneven(Law::kElastica, phi, exact.chord, 0.0);
        std::printf("%.2f %.2f %.1f: %+.4f %+.5f; %+.3f %+.5f\n", chi, phi, f, at.F / f - 1.0,
                    at.tip_turn + exact.lead, even.F / f - 1.0, even.tip_turn + exact.lead);
        EXPECT_NEAR(at.F / f, 1.0, 2.0 * chi * chi / f) << chi << ' ' << phi << ' ' << f;
        EXPECT_NEAR(at.tip_turn, -exact.lead, 0.5 * chi * chi + 0.4 * std::abs(chi) * f * f)
            << chi << ' ' << phi << ' ' << f;
      }
    }
  }
}

TEST(UnevenCurvature, KeepsTheEnergyRollingAndOnTheToe) {
  for (const Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica}) {
    for (const double h : {0.0, 0.03}) {
      for (const double theta : {30.0, 8.0, -10.0}) {
        SimulationRequest q = ThickLegRequest(law);
        q.parameters.d = 0.0;
        q.parameters.theta_td = Degrees(theta);
        const std::array effects = {Setting("uneven_curvature", 0.06),
                                    Setting("sole_thickness", h * q.parameters.r)};
        q.effects = effects;
        const Trajectory run = Simulate(q);
        ASSERT_GE(run.events.size(), 2u) << NameOf(law) << theta;
        ASSERT_EQ(run.events[0].kind, EventKind::kTouchdown);
        const double before = Energy(q, Mode::kFlight, q.initial);
        EXPECT_NEAR(EnergyAtEnd(q, run) / before, 1.0, kEnergyDrift) << NameOf(law) << theta;
      }
    }
  }
}

TEST(UnevenCurvature, OfNoneIsThePlainLeg) {
  for (const Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica}) {
    SimulationRequest q = ExcitedRequest(law);
    const Trajectory plain = Simulate(q);
    const std::array effects = {Setting("uneven_curvature", 0.0)};
    q.effects = effects;
    const Trajectory on = Simulate(q);
    ASSERT_EQ(EventNames(on), EventNames(plain)) << NameOf(law);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(on.final_state[i], plain.final_state[i], 1e-9) << NameOf(law);
  }
}

// The strip's own shape, unloaded: to the second order in chi that M124 leaves out.
TEST(UnevenCurvature, LandsAsTheUnloadedStrip) {
  constexpr double chi = 0.05;
  for (const double theta : {30.0, 8.0, -10.0}) {
    SimulationRequest q = ThickLegRequest(Law::kElastica);
    q.parameters.theta_td = Degrees(theta);
    const double r = q.parameters.r, angle = q.parameters.theta_td;
    const std::array effects = {Setting("uneven_curvature", chi)};
    q.effects = effects;
    const double landed = First(Simulate(q), EventKind::kTouchdown).time;
    const std::array channels = {Channel::kBodyY, Channel::kLegAngle, Channel::kLegLength};
    const std::array rows = {landed + 1e-9};
    q.channels = channels;
    q.row_times = rows;
    const Trajectory to = Simulate(q);
    // The arc that turns through pi - theta; on the toe the whole one, turned by theta.
    double phi = std::numbers::pi;
    if (theta > 0.0) {
      double low = 0.1, high = std::numbers::pi;
      for (int i = 0; i < 60; ++i) {
        phi = 0.5 * (low + high);
        (StandingStrip(phi, 0.0, 0.0, chi).turned < std::numbers::pi - angle ? low : high) = phi;
      }
    }
    const StandingStrip stands(phi, 0.0, 0.0, chi);
    const double lean = std::asin(stands.lead) + (theta > 0.0 ? 0.0 : angle);
    EXPECT_NEAR(to.samples[0] / r, stands.chord * std::cos(lean), 0.4 * chi * chi) << theta;
    EXPECT_NEAR(to.samples[1], angle, 0.2 * chi * chi) << theta;
    EXPECT_NEAR(to.samples[2] / r, stands.chord, 0.4 * chi * chi) << theta;
  }
}

}  // namespace
}  // namespace hoplab
