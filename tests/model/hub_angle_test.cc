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
SimulationRequest BendingHop(double angle_deg) {
  SimulationRequest q = ThickLegRequest(Law::kElastica);
  q.parameters.d = q.parameters.kp = 0.0;
  q.parameters.A = 1e3;
  q.parameters.G = 1e18;
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

// The hopper loses what the friction of its joint rubs: the little that it takes from the body
// across the chord, and what it takes by bending the leg.
TEST(HubAngle, FrictionTakesWhatItRubsAtTheJoint) {
  SimulationRequest q = BendingHop(30.0);
  const double b_h = 0.002;
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
  const std::array channels = {Channel::kHipTorque};
  q.row_times = times;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  double rubbed = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i)
    rubbed += weights[i] * run.samples[i] * run.samples[i] / b_h;
  const double start = Energy(q, Mode::kFlight, q.initial);
  const double share = (start - EnergyAtEnd(q, run)) / rubbed;
  std::printf("  friction rubs %.2f %% of the energy, the hopper loses %.4f of that\n",
              100.0 * rubbed / start, share);
  EXPECT_GT(rubbed, 1e-3 * start);
  EXPECT_NEAR(share, 1.0, 0.02);
}

}  // namespace
}  // namespace hoplab
