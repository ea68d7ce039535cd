#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <functional>

#include "model/effects/effect.h"
#include "model/mechanisms/leg_inertia.h"
#include "tests/support/effect_requests.h"
#include "tests/support/elastica.h"

// A leg with a mass of its own, M56-M60.

namespace hoplab {
namespace {

using namespace testing;

double EnergyOf(const SimulationRequest& q, const Trajectory& run) {
  return Energy(q, run.final_mode, run.final_state);
}

TEST(LegMass, KeepsTheEnergyOfAStanceFromTheBlowOfLandingOn) {
  for (Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica, Law::kStraightLeg}) {
    for (double theta : {30.0, 8.0, -10.0}) {
      SimulationRequest q = ExcitedRequest(law);
      q.parameters.d = q.parameters.kp = 0.0;
      q.parameters.theta_td = Degrees(theta);
      if (law != Law::kStraightLeg) q.initial = {0.0, 0.25, 0.7, -0.1};
      const std::array effects = {Setting("leg_mass", 0.1 * q.parameters.m)};
      q.effects = effects;
      const Trajectory hop = Simulate(q);
      ASSERT_EQ(hop.events[0].kind, EventKind::kTouchdown) << NameOf(law) << ' ' << theta;
      const double down = hop.events[0].time;
      double up = hop.end_time;
      for (const Event& e : hop.events) {
        if (e.kind == EventKind::kLiftoff) up = e.time;
      }
      const double before = Energy(q, Mode::kFlight, q.initial);
      q.horizon = down + 1e-9;
      const double landed = EnergyOf(q, Simulate(q));
      EXPECT_LT(landed, before * (1.0 - 1e-3)) << "the blow takes energy";
      for (double part : {0.2, 0.5, 0.8, 0.99}) {
        q.horizon = down + part * (up - down);
        EXPECT_NEAR(EnergyOf(q, Simulate(q)) / landed, 1.0, kEnergyDrift)
            << NameOf(law) << ' ' << theta << ' ' << part;
      }
    }
  }
}

TEST(LegMass, OnAStraightLegIsABarOnASpring) {
  // Straight down: a spring with a bar of mass m_leg over it, of which a third moves.
  SimulationRequest q = SteadyStraightLeg();
  q.parameters.theta_td = 0.0;
  q.initial = {0.0, 1.3, 0.0, -1.0};
  const double m = q.parameters.m, m_leg = 12.0, g = q.parameters.g, k = q.parameters.k;
  const std::array effects = {Setting("leg_mass", m_leg)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  const double v = std::sqrt(1.0 + 2.0 * g * 0.3), moving = m - 2.0 * m_leg / 3.0;
  const double landed = v * (m - 0.5 * m_leg) / moving;
  const double omega = std::sqrt(k / moving), sag = (m - 0.5 * m_leg) * g / k;
  // y - l0 = -sag + sag cos(wt) - (landed/w) sin(wt) is back at 0.
  const double half_turn = 2.0 * (std::numbers::pi - std::atan2(landed / omega, sag));
  ASSERT_EQ(run.events[0].kind, EventKind::kTouchdown);
  ASSERT_EQ(run.events[1].kind, EventKind::kLiftoff);
  EXPECT_NEAR(run.events[0].vy_after, -landed, 1e-10);
  EXPECT_NEAR(run.events[1].time - run.events[0].time, half_turn / omega, 1e-10);
  EXPECT_NEAR(run.events[1].vy, landed, 1e-9);
  EXPECT_NEAR(run.events[1].vy_after, landed * (m - 0.5 * m_leg) / m, 1e-9);
}

TEST(LegMass, ABlowThatTakesTheBodyPastItsMotorsLimitLeavesItAtTheLimit) {
  SimulationRequest q = ExcitedRequest(Law::kConsistent);
  q.parameters.v_des = 0.4;
  const std::array effects = {Setting("leg_mass", 0.1 * q.parameters.m)};
  q.effects = effects;
  const Event landing = Simulate(q).events.at(0);
  ASSERT_EQ(landing.kind, EventKind::kTouchdown);
  const auto asked = [&](double vx) {
    return std::abs(q.parameters.kp * (q.parameters.v_des - vx));
  };
  ASSERT_GT(asked(landing.vx_after), asked(landing.vx) * 1.01);
  q.parameters.torque_limit = 0.5 * (asked(landing.vx) + asked(landing.vx_after));
  const std::array rows = {landing.time + 1e-6, landing.time + 1e-4, landing.time + 1e-3};
  const std::array channels = {Channel::kHipTorque};
  q.row_times = rows;
  q.channels = channels;
  for (const double torque : Simulate(q).samples)
    EXPECT_LE(std::abs(torque), q.parameters.torque_limit * (1.0 + 1e-12));
}

TEST(LegMass, TakesTheCentreOfMassThroughLiftOffUnmoved) {
  SimulationRequest q = ExcitedRequest(Law::kLargeDeflection);
  q.parameters.kp = 0.0;
  const double m_leg = 0.08;
  const std::array effects = {Setting("leg_mass", m_leg)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  const Event& up = run.events[1];
  ASSERT_EQ(up.kind, EventKind::kLiftoff);
  q.horizon = up.time - 1e-10;
  const Trajectory before = Simulate(q);
  q.horizon = up.time + 1e-10;
  const Trajectory after = Simulate(q);
  // The rolled half circle of a leg that carries nothing, and the one at touch-down: both hang from
  // the hip, the centre of mass 2 r/pi from the middle of the circle.
  const double r = q.parameters.r;
  const auto centre = [&](double theta) {
    const double off = 2.0 * r / std::numbers::pi;
    return std::array{r * std::sin(theta) - off * std::cos(theta),
                      -r * std::cos(theta) - off * std::sin(theta)};
  };
  const std::array channels = {Channel::kLegAngle};
  const std::vector<double> times = {up.time - 1e-10};
  q.row_times = times;
  q.channels = channels;
  const double left = Simulate(q).samples[0];
  const auto from = centre(left), to = centre(q.parameters.theta_td);
  const double share = m_leg / q.parameters.m;
  // A damped leg leaves a little pressed.
  EXPECT_NEAR(after.final_state[0] - before.final_state[0], share * (from[0] - to[0]), 2e-4);
  EXPECT_NEAR(after.final_state[1] - before.final_state[1], share * (from[1] - to[1]), 2e-4);
  EXPECT_GT(std::abs(after.final_state[0] - before.final_state[0]), 1e-3);
}

// M88: the body is seen where it was as the leg leaves the ground; at the apex and from there on
// the state is what is seen.
TEST(LegMass, IsSeenToSwingForwardUntilTheApex) {
  for (const Law law : {Law::kElastica, Law::kThesis, Law::kStraightLeg}) {
    SimulationRequest q = ExcitedRequest(law);
    q.max_hops = 0;
    const std::array effects = {Setting("leg_mass", 0.08 * q.parameters.m)};
    q.effects = effects;
    const Trajectory run = Simulate(q);
    const Event& up = run.events[1];
    ASSERT_EQ(up.kind, EventKind::kLiftoff) << NameOf(law);
    ASSERT_GT(up.vy_after, 0.0) << NameOf(law);
    const double whole = up.vy_after / q.parameters.g;
    const std::array channels = {Channel::kBodyX, Channel::kBodyY};
    const auto seen = [&](double time) {
      SimulationRequest at = q;
      const std::vector<double> times = {time};
      at.row_times = times;
      at.channels = channels;
      const Trajectory part = Simulate(at);
      return std::array{part.samples[0], part.samples[1]};
    };
    const auto state = [&](double time) {
      SimulationRequest at = q;
      at.horizon = time;
      const Trajectory part = Simulate(at);
      return std::array{part.final_state[0], part.final_state[1]};
    };
    const auto before = seen(up.time - 1e-9), after = seen(up.time + 1e-9);
    const auto swung = state(up.time + 1e-9);
    const double middle = up.time + 0.5 * whole, late = up.time + 1.01 * whole;
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(after[k], before[k], 1e-7) << NameOf(law);
      const double way = after[k] - swung[k];
      EXPECT_NEAR(seen(middle)[k] - state(middle)[k], 0.5 * way, 1e-9) << NameOf(law);
      EXPECT_NEAR(seen(late)[k], state(late)[k], 1e-12) << NameOf(law);
    }
    EXPECT_GT(std::abs(after[0] - swung[0]), 1e-3) << NameOf(law);
  }
}

// No leg has swung before the start of a run, where a camera that is late reads its first rows.
TEST(LegMass, ReadsRowsBeforeTheStart) {
  SimulationRequest q = ExcitedRequest(Law::kElastica);
  const std::array effects = {Setting("leg_mass", 0.08 * q.parameters.m),
                              Setting("sensor_delay", 0.01)};
  q.effects = effects;
  const std::vector<double> times = {0.0, 0.005};
  const std::array channels = {Channel::kBodyX, Channel::kBodyY};
  q.row_times = times;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  EXPECT_NEAR(run.samples[0], q.initial[0] - 0.01 * q.initial[2], 1e-9);
  EXPECT_NEAR(run.samples[2], q.initial[0] - 0.005 * q.initial[2], 1e-9);
}

// A pressed arc of radius 1, E I = 1, that rolls: where its points are, at fractions of its length
// from the contact to the hip.
constexpr int kPoints = 400;
struct Points {
  std::array<std::array<double, 2>, kPoints + 1> at;
};
Points ShapeOf(double phi, double f) {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, 4>;  // x, y, angle of the tangent, curvature
  const double foot = SolvePressedArc(phi, 1.0, 1.0, f).end_angle;
  State s = {phi, 0.0, 0.0, 1.0};
  Points points;
  points.at[0] = {s[0], s[1]};
  odeint::runge_kutta_fehlberg78<State> step;
  const double h = phi / kPoints;
  for (int i = 0; i < kPoints; ++i) {
    step.do_step(
        [&](const State& q, State& d, double) {
          d = {-std::cos(q[2]), std::sin(q[2]), q[3], f * std::sin(foot - q[2])};
        },
        s, 0.0, h);
    points.at[i + 1] = {s[0], s[1]};
  }
  return points;
}

TEST(LegMass, MassMatrixIsThatOfTheElasticasShapeToAFewHundredths) {
  std::printf("phi  pressed  M of the elastica        M56                      worst error\n");
  for (double phi : {2.4, 2.7, 3.0}) {
    for (double f : {1e-3, 0.1, 0.2}) {
      // Slopes of the place of a point of the material by (phi, f), the contact rolling.
      const double e = 1e-4;
      const Points longer = ShapeOf(phi + e, f), shorter = ShapeOf(phi - e, f),
                   more = ShapeOf(phi, f + e), less = ShapeOf(phi, f - e), here = ShapeOf(phi, f);
      const auto at = [](const Points& p, double length, double from_hip, int k) {
        // Cubic between the points.
        const double x = (length - from_hip) / length * kPoints;
        const int i = std::clamp(static_cast<int>(x) - 1, 0, kPoints - 3);
        const double t = x - i;
        return -(t - 1) * (t - 2) * (t - 3) / 6 * p.at[i][k] +
               t * (t - 2) * (t - 3) / 2 * p.at[i + 1][k] -
               t * (t - 1) * (t - 3) / 2 * p.at[i + 2][k] +
               t * (t - 1) * (t - 2) / 6 * p.at[i + 3][k];
      };
      const auto slopes = [&](double from_hip) {
        std::array<std::array<double, 2>, 2> d;
        for (int k = 0; k < 2; ++k) {
          d[k][0] =
              (at(longer, phi + e, from_hip, k) - at(shorter, phi - e, from_hip, k)) / (2 * e);
          d[k][1] = (at(more, phi, from_hip, k) - at(less, phi, from_hip, k)) / (2 * e);
        }
        return d;
      };
      const auto hip = slopes(0.0);
      const double det = hip[0][0] * hip[1][1] - hip[0][1] * hip[1][0];
      const double phi_x = hip[1][1] / det, phi_y = -hip[0][1] / det;
      const double f_x = -hip[1][0] / det, f_y = hip[0][0] / det;
      double xx = 0.0, xy = 0.0, yy = 0.0;
      constexpr int kPieces = 500;
      for (int i = 0; i < kPieces; ++i) {
        const double s = std::numbers::pi * (i + 0.5) / kPieces;
        std::array<std::array<double, 2>, 2> d{};
        if (s < phi) {
          d = slopes(s);
        } else {  // what lies beyond the contact rolls with it
          d[0][0] = 1.0 - std::cos(s - phi);
          d[1][0] = -std::sin(s - phi);
        }
        const double xh = d[0][0] * phi_x + d[0][1] * f_x, xv = d[0][0] * phi_y + d[0][1] * f_y;
        const double yh = d[1][0] * phi_x + d[1][1] * f_x, yv = d[1][0] * phi_y + d[1][1] * f_y;
        xx += (xh * xh + yh * yh) / kPieces;
        xy += (xh * xv + yh * yv) / kPieces;
        yy += (xv * xv + yv * yv) / kPieces;
      }
      LegLoad<double> load{};
      load.u = phi - here.at[kPoints][0];
      load.y = here.at[kPoints][1];
      load.l = std::hypot(load.u, load.y);
      load.phi = phi;
      load.arc_x = load.place_x = phi_x;
      load.arc_y = load.place_y = phi_y;
      const LegInertia<double> leg = ArcInertia(1.0, 1.0, ShapeOfArc(1.0, 0.0, load));
      const double error = std::max(
          {std::abs(leg.xx.value - xx), std::abs(leg.xy.value - xy), std::abs(leg.yy.value - yy)});
      std::printf("%.1f  %.3f  %.4f %.4f %.4f   %.4f %.4f %.4f   %.4f\n", phi,
                  1.0 - load.l / (2.0 * std::sin(0.5 * phi)), xx, xy, yy, leg.xx.value,
                  leg.xy.value, leg.yy.value, error);
      EXPECT_LT(error, 0.02) << phi << ' ' << f;
    }
  }
}

}  // namespace
}  // namespace hoplab
