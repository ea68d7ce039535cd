#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "model/laws/extended_statics.h"
#include "tests/support/effect_requests.h"
#include "tests/support/standing_strip.h"

// A leg that bends along its middle line and stands on its outside, M113.

namespace hoplab {
namespace {

using namespace testing;

Statics<double> StaticsOnSole(Law law, double phi, double chord, double h) {
  Parameters<double> p;
  p.r = p.E = p.I = 1.0;
  p.A = p.G = 1e12;
  p.law_terms.active = p.law_terms.sole_active = true;
  p.law_terms.sole = h;
  return StaticsAt<double, double>(p, law, 0.0, {phi, chord, 1.0});
}

TEST(Sole, SmallLoadsAreThoseOfTheStripOnItsSole) {
  for (const double phi : {0.6, 1.2, 2.0, 2.8, std::numbers::pi}) {
    for (const double h : {0.0, 0.02, 0.2}) {
      const double f = 1e-4;
      const StandingStrip more(phi, f, h), less(phi, -f, h);
      const double rest = 0.5 * (more.chord + less.chord);
      const double stiffness = 2.0 * f / (less.chord - more.chord);
      const double shorter = f / stiffness;
      const Statics<double> at = StaticsOnSole(Law::kElastica, phi, rest - shorter, h);
      const Statics<double> pulled = StaticsOnSole(Law::kElastica, phi, rest + shorter, h);
      EXPECT_NEAR((at.F - pulled.F) / (2.0 * f), 1.0, 2e-6) << phi << ' ' << h;
      EXPECT_NEAR(0.5 * (at.tip_turn + pulled.tip_turn), -0.5 * (more.by_arc + less.by_arc), 1e-8);
      EXPECT_NEAR((at.tip_turn - pulled.tip_turn) / (less.by_arc - more.by_arc), 1.0, 2e-5)
          << phi << ' ' << h;
    }
  }
}

// What is left of the sole under load, against what the law would miss without one.
TEST(Sole, LargeLoadsAreNearlyThoseOfTheStripOnItsSole) {
  std::printf("h/r, phi, f: chord's force over the exact one - 1, lead off; without the sole\n");
  for (const double h : {0.02, 0.1}) {
    for (const double phi : {1.6, 2.2, 2.8, std::numbers::pi}) {
      for (const double f : {0.1, 0.3}) {
        const StandingStrip exact(phi, f, h);
        const Statics<double> on = StaticsOnSole(Law::kElastica, phi, exact.chord, h);
        const StandingStrip bare(phi, f, 0.0);
        const double rest = 2.0 * std::sin(0.5 * phi), rest_on = StandingStrip(phi, 0.0, h).chord;
        const double without = (rest - bare.chord) / (rest_on - exact.chord) - 1.0;
        std::printf("%.2f %.2f %.1f: %+.4f %+.5f; %+.3f\n", h, phi, f, on.F / f - 1.0,
                    on.tip_turn + exact.by_arc, without);
        EXPECT_NEAR(on.F / f, 1.0, 0.3 * h * f) << h << ' ' << phi << ' ' << f;
        EXPECT_NEAR(on.tip_turn, -exact.by_arc, 0.02 * h) << h << ' ' << phi << ' ' << f;
      }
    }
  }
}

TEST(Sole, KeepsTheEnergyRollingAndOnTheToe) {
  for (const Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica}) {
    for (const double theta : {30.0, 8.0, -10.0}) {
      SimulationRequest q = ThickLegRequest(law);
      q.parameters.d = 0.0;
      q.parameters.theta_td = Degrees(theta);
      const std::array effects = {Setting("sole_thickness", 0.05 * q.parameters.r)};
      q.effects = effects;
      const Trajectory run = Simulate(q);
      ASSERT_GE(run.events.size(), 2u) << NameOf(law) << theta;
      ASSERT_EQ(run.events[0].kind, EventKind::kTouchdown);
      const double before = Energy(q, Mode::kFlight, q.initial);
      EXPECT_NEAR(EnergyAtEnd(q, run) / before, 1.0, kEnergyDrift) << NameOf(law) << theta;
    }
  }
}

TEST(Sole, OfNoThicknessIsThePlainLeg) {
  for (const Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica}) {
    SimulationRequest q = ExcitedRequest(law);
    const Trajectory plain = Simulate(q);
    const std::array effects = {Setting("sole_thickness", 0.0)};
    q.effects = effects;
    const Trajectory on = Simulate(q);
    ASSERT_EQ(EventNames(on), EventNames(plain)) << NameOf(law);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(on.final_state[i], plain.final_state[i], 1e-9) << NameOf(law);
  }
}

// It lands as a wheel of r + h with its hip at r from the middle.
TEST(Sole, LandsWhereTheUnloadedCircleMeetsTheGround) {
  for (const double theta : {30.0, 8.0, -10.0}) {
    SimulationRequest q = ThickLegRequest(Law::kElastica);
    q.parameters.theta_td = Degrees(theta);
    const double r = q.parameters.r, h = 0.1 * r;
    const std::array effects = {Setting("sole_thickness", h)};
    q.effects = effects;
    const double landed = First(Simulate(q), EventKind::kTouchdown).time;
    const std::array channels = {Channel::kBodyY, Channel::kLegAngle, Channel::kLegLength,
                                 Channel::kGroundForceY};
    const std::array rows = {landed + 1e-9};
    q.channels = channels;
    q.row_times = rows;
    const Trajectory to = Simulate(q);
    const double angle = q.parameters.theta_td, up = std::cos(angle);
    const double height = theta > 0.0 ? r + h + r * up : (2.0 * r + h) * up;
    const double lead = theta > 0.0 ? r * std::sin(angle) : (2.0 * r + h) * std::sin(angle);
    EXPECT_NEAR(to.samples[0], height, 1e-8) << theta;
    EXPECT_NEAR(to.samples[1], angle, 1e-7) << theta;
    EXPECT_NEAR(to.samples[2], std::hypot(lead, height), 1e-8) << theta;
    EXPECT_NEAR(to.samples[3], 0.0, 10.0) << theta;  // the damper alone
  }
}

}  // namespace
}  // namespace hoplab
