// The leg angle where an elastica is clamped to the hip (M93), and what friction does there (M94).
#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "model/effects/effect.h"
#include "tests/support/effect_requests.h"
#include "tests/support/elastica.h"

namespace hoplab {
namespace {

using namespace testing;

// A hop of a leg that only bends, on its arc or from its tip.
SimulationRequest BendingHop(double angle_deg, double stiffer = 1.0) {
  SimulationRequest q = ThickLegRequest(Law::kElastica);
  q.parameters.d = q.parameters.kp = 0.0;
  q.parameters.A = 1e3;
  q.parameters.G = 1e18;
  q.parameters.E *= stiffer;
  q.parameters.theta_td = Degrees(angle_deg);
  q.initial = {0.0, 0.25, 0.7, -0.1};
  return q;
}

TEST(HubAngle, IsTheTangentOfTheShotElasticaAtItsOtherEnd) {
  int rolling = 0, on_toe = 0;
  for (const double angle : {30.0, 8.0, -10.0}) {
    SimulationRequest q = BendingHop(angle);
    const Trajectory whole = Simulate(q);
    const std::vector<double> times = EvenTimes(whole.end_time, 60);
    const std::array channels = {Channel::kLegAngle,     Channel::kBodyX,       Channel::kBodyY,
                                 Channel::kContactX,     Channel::kContactArc,  Channel::kContact,
                                 Channel::kGroundForceX, Channel::kGroundForceY};
    q.row_times = times;
    q.channels = channels;
    const Trajectory run = Simulate(q);
    for (std::size_t i = 0; i < run.samples.size() / channels.size(); ++i) {
      const double* row = &run.samples[channels.size() * i];
      if (row[5] != 1.0) continue;
      const auto& p = q.parameters;
      const double force = std::hypot(row[6], row[7]), arc = row[4];
      const PressedArc exact = SolvePressedArc(arc, p.r, p.E * p.I, force);
      const double chord = std::atan2(row[3] - row[1], row[2]);
      EXPECT_NEAR(row[0], chord + 0.5 * std::numbers::pi - exact.end_angle, 1e-7) << angle;
      (arc < std::numbers::pi ? rolling : on_toe) += 1;
    }
  }
  EXPECT_GT(rolling, 10);
  EXPECT_GT(on_toe, 10);
}

// Of a hop with friction at the joint, from touch-down to lift-off.
struct Rubbed {
  double start, lost;             // energy of the hopper; what it loses [J]
  double at_joint, across_chord;  // rubbed; taken from the body alone [J]
};

Rubbed HopThatRubs(double b_h, double stiffer) {
  SimulationRequest q = BendingHop(30.0, stiffer);
  const std::array effects = {Setting("hip_viscous_friction", b_h)};
  q.effects = effects;
  const Trajectory whole = Simulate(q);
  const double begin = First(whole, EventKind::kTouchdown).time;
  q.horizon = First(whole, EventKind::kLiftoff).time - 1e-9;
  using Rule = boost::math::quadrature::gauss<double, 20>;
  constexpr int kPanels = 20;
  const double half = 0.5 * (q.horizon - begin) / kPanels;
  std::vector<double> times, weights;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double middle = begin + (2 * panel + 1) * half;
    for (int side : {-1, 1}) {
      for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
        const std::size_t i = side < 0 ? Rule::abscissa().size() - 1 - k : k;
        times.push_back(middle + side * half * Rule::abscissa()[i]);
        weights.push_back(half * Rule::weights()[i]);
      }
    }
  }
  const std::array channels = {Channel::kHipTorque, Channel::kBodyX,  Channel::kBodyY,
                               Channel::kBodyVx,    Channel::kBodyVy, Channel::kContactX};
  q.row_times = times;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  const double start = Energy(q, Mode::kFlight, q.initial);
  Rubbed out{start, start - EnergyAtEnd(q, run), 0.0, 0.0};
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double* row = &run.samples[channels.size() * i];
    const double torque = row[0], u = row[5] - row[1], y = row[2];
    out.at_joint += weights[i] * torque * torque / b_h;
    out.across_chord -= weights[i] * torque * (y * row[3] + u * row[4]) / (u * u + y * y);
  }
  return out;
}

// The hopper loses what the friction of its joint rubs: the little that it takes from the body
// across the chord, and what it takes by bending the leg. A torque bends the leg to second order of
// the load (M24), so what is off falls with the load: by half each time the leg is twice as stiff.
TEST(HubAngle, FrictionTakesWhatItRubsAtTheJoint) {
  struct Case {
    double stiffer, bound;
  };
  for (const Case c : {Case{1.0, 0.015}, Case{8.0, 0.002}, Case{64.0, 0.0003}}) {
    const Rubbed of = HopThatRubs(0.002, c.stiffer);
    const double share = of.lost / of.at_joint, from_body = of.across_chord / of.at_joint;
    std::printf(
        "  E x %2.0f: the hopper loses %.5f of what friction rubs, %.3f from the body alone\n",
        c.stiffer, share, from_body);
    if (c.stiffer == 1.0) {
      EXPECT_GT(of.at_joint, 1e-3 * of.start);
    }
    EXPECT_NEAR(share, 1.0, c.bound);
    EXPECT_LT(from_body, 0.1);
  }
}

}  // namespace
}  // namespace hoplab
