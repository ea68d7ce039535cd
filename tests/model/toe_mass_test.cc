#include "tests/support/toe_mass.h"

#include <gtest/gtest.h>

#include <array>

#include "model/leg_compliance.h"
#include "tests/support/matrix_near.h"

namespace hoplab {
namespace {

using namespace testing;

struct ToeMass : ::testing::TestWithParam<Law> {};

std::array<double, 2> Momentum(const SimulationRequest& q, const std::vector<double>& z) {
  const double m = q.parameters.m, toe = q.parameters.m_toe;
  return {m * z[2] + toe * z[6], m * z[3] + toe * z[7]};
}

// ---- flight ------------------------------------------------------------------------------

TEST_P(ToeMass, FlightKeepsHorizontalMomentumAndFallsWithTheWeightOfBoth) {
  const SimulationRequest q = ToeMassRequest(GetParam());
  const Trajectory a = Simulate(EndedAfter(q, EventKind::kLiftoff, 0.001));
  const double later = 0.09;
  const Trajectory b = Simulate(EndedAfter(q, EventKind::kLiftoff, later));
  ASSERT_EQ(a.final_mode, Mode::kFlight);
  ASSERT_EQ(b.final_mode, Mode::kFlight);
  ASSERT_EQ(b.final_state.size(), 8u);
  const auto p0 = Momentum(q, a.final_state), p1 = Momentum(q, b.final_state);
  const double weight = (q.parameters.m + q.parameters.m_toe) * q.parameters.g;
  EXPECT_NEAR(p1[0], p0[0], 1e-11);
  EXPECT_NEAR(p1[1] - p0[1], -weight * (b.end_time - a.end_time), 1e-11);
  // It is not each for itself: the toe was swung forward.
  EXPECT_GT(std::abs(b.final_state[6] - a.final_state[6]), 0.02);
}

TEST_P(ToeMass, FlightIsThatOfTwoBodiesOnASpringAndATorque) {
  const SimulationRequest q = ToeMassRequest(GetParam());
  const auto& p = q.parameters;
  TwoBodies pair{p.m, p.m_toe, p.g, {}, p.d, p.kp_place, p.kd_place, p.theta_td};
  const double toe = M_PI;
  if (q.law == Law::kStraightLeg) {
    pair.spring = [&](double l) { return p.k * (p.l0 - l); };
  } else if (q.law == Law::kConsistent) {
    pair.spring = [&](double l) { return (2 * p.r - l) / LegCompliance<double>(p).Chord(toe); };
  } else if (q.law == Law::kLargeDeflection) {
    pair.spring = [&](double l) {  // F from M9b by bisection
      const LegCompliance<double> leg(p);
      double low = -200.0, high = 200.0;
      for (int i = 0; i < 80; ++i) {
        const double F = 0.5 * (low + high);
        (2 * p.r - F * (leg.Chord(toe) + F * leg.SecondOrder(toe)) > l ? low : high) = F;
      }
      return low;
    };
  } else {
    pair.spring = [&](double l) {
      return (2 * p.r - l) / LegCompliance<double>(p, 0.5 * l).Chord(toe);
    };
  }
  const double from = 1e-6, for_seconds = 0.05;
  const Trajectory a = Simulate(EndedAfter(q, EventKind::kLiftoff, from));
  const Trajectory b = Simulate(EndedAfter(q, EventKind::kLiftoff, from + for_seconds));
  TwoBodies::State z{};
  std::copy(a.final_state.begin(), a.final_state.end(), z.begin());
  z = pair.After(z, b.end_time - a.end_time, 4000);
  EXPECT_TRUE(MatrixNear(b.final_state, std::vector<double>(z.begin(), z.begin() + 8), 1e-10));
  // Energy balance: what placement puts in, less what damper and placement take out.
  if (q.law == Law::kThesis || q.law == Law::kNoSlip) return;
  const auto held = [&](const std::vector<double>& s) {
    const double away = p.theta_td - std::atan2(s[4] - s[0], s[1] - s[5]);
    return 0.5 * p.kp_place * away * away;
  };
  const double before = Energy(q, Mode::kFlight, a.final_state) + held(a.final_state);
  const double after = Energy(q, Mode::kFlight, b.final_state) + held(b.final_state);
  EXPECT_GT(z[8], 1e-3);
  EXPECT_NEAR(before - after, z[8], 1e-10);
}

TEST_P(ToeMass, FirstFlightOfARelaxedLegIsAParabolaOfBoth) {
  SimulationRequest q = ToeMassRequest(GetParam());
  q.horizon = 0.05;
  const Trajectory run = Simulate(q);
  ASSERT_TRUE(run.events.empty());
  EXPECT_EQ(run.steps, 0);
  const double t = q.horizon, fall = -0.5 * q.parameters.g * t * t;
  const double l = ToeChord(q), theta = q.parameters.theta_td;
  const auto& s = q.initial;
  const double x = s[0] + s[2] * t, y = s[1] + s[3] * t + fall, vy = s[3] - q.parameters.g * t;
  const std::vector<double> expected = {
      x, y, s[2], vy, x + l * std::sin(theta), y - l * std::cos(theta), s[2], vy};
  EXPECT_TRUE(MatrixNear(run.final_state, expected, 1e-14));
}

// ---- touch-down, stance, lift-off --------------------------------------------------------

// Total energy a moment before and after an event.
std::array<double, 2> EnergyAround(const SimulationRequest& q, EventKind kind, int number) {
  std::array<double, 2> energy;
  for (int side = 0; side < 2; ++side) {
    const SimulationRequest at = EndedAfter(q, kind, side == 0 ? -1e-12 : 1e-12, number);
    const Trajectory run = Simulate(at);
    energy[side] = Energy(q, run.final_mode, run.final_state);
  }
  return energy;
}
double ToeSpeedBefore(const SimulationRequest& q, int touchdown) {
  const Trajectory run = Simulate(EndedAfter(q, EventKind::kTouchdown, -1e-12, touchdown));
  return std::hypot(run.final_state[6], run.final_state[7]);
}

TEST_P(ToeMass, TouchdownLosesTheToesKineticEnergy) {
  for (double deg : {20.0, -8.0}) {
    SimulationRequest q = ToeMassRequest(GetParam());
    q.parameters.theta_td = Degrees(deg);
    const auto [before, after] = EnergyAround(q, EventKind::kTouchdown, 1);
    const double speed = ToeSpeedBefore(q, 1);
    EXPECT_GT(speed, 1.0);
    EXPECT_NEAR(before - after, 0.5 * q.parameters.m_toe * speed * speed, 1e-10) << deg;
  }
}

TEST(ToeMassStraightLeg, TouchdownOfAVibratingLegLosesTheToesKineticEnergyAlone) {
  SimulationRequest q = ToeMassRequest(Law::kStraightLeg);
  q.parameters.d = 0.5;
  q.parameters.kp = 0.6;
  q.parameters.v_des = 1.0;
  const auto [before, after] = EnergyAround(q, EventKind::kTouchdown, 2);
  const double speed = ToeSpeedBefore(q, 2);
  EXPECT_NEAR(before - after, 0.5 * q.parameters.m_toe * speed * speed, 1e-10);
}

struct ConservativeToeMass : ::testing::TestWithParam<Law> {};

TEST_P(ConservativeToeMass, HopOnTheToeLosesEnergyAtTouchdownAlone) {
  SimulationRequest q = ToeMassRequest(GetParam());
  q.parameters.theta_td = Degrees(-8.0);
  q.initial[2] = 0.3;
  q.parameters.d = q.parameters.kp_place = q.parameters.kd_place = 0.0;
  const Trajectory run = Simulate(q);
  ASSERT_EQ(EventNames(run), "touchdown liftoff apex");
  const double speed = ToeSpeedBefore(q, 1);
  const double start = Energy(q, Mode::kFlight, q.initial);
  EXPECT_NEAR(start - Energy(q, Mode::kFlight, run.final_state),
              0.5 * q.parameters.m_toe * speed * speed, 1e-10);
}

TEST_P(ConservativeToeMass, RollingStanceKeepsTheEnergyOfHipAndLeg) {
  if (GetParam() == Law::kStraightLeg) return;
  SimulationRequest q = ToeMassRequest(GetParam());
  q.parameters.d = 0.0;
  SimulationRequest massless = q;
  massless.parameters.m_toe = 0.0;
  const auto hip_energy = [&](double after) {
    const Trajectory run = Simulate(EndedAfter(q, EventKind::kTouchdown, after));
    EXPECT_EQ(run.final_mode, Mode::kRolling);
    return Energy(massless, run.final_mode, std::span(run.final_state).first(5));
  };
  const double landed = hip_energy(1e-12);
  for (double after : {0.01, 0.025, 0.04}) {
    EXPECT_NEAR(hip_energy(after), landed, 1e-9) << after;
  }
}

INSTANTIATE_TEST_SUITE_P(Law, ConservativeToeMass,
                         ::testing::Values(Law::kConsistent, Law::kLargeDeflection,
                                           Law::kStraightLeg),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

TEST_P(ToeMass, LeavesTheGroundWhenTheChordLiftsTheToesWeight) {
  SimulationRequest q = ToeMassRequest(GetParam());
  q.parameters.d = 0.0;
  const double weight = q.parameters.m_toe * q.parameters.g;
  const Trajectory run = Simulate(q);
  const std::array times = {run.events[1].time - 1e-9};
  ASSERT_EQ(run.events[1].kind, EventKind::kLiftoff);
  const std::array channels = {Channel::kGroundForceY};
  q.row_times = times;
  q.channels = channels;
  // Without a hip torque the ground's force is what presses the toe down.
  EXPECT_NEAR(Simulate(q).samples[0], 0.0, 1e-3 * weight);
}

TEST_P(ToeMass, LiftoffLeavesTheLegTouchingTheGroundWithItsToeAtRest) {
  const SimulationRequest q = ToeMassRequest(GetParam());
  const Trajectory run = Simulate(EndedAfter(q, EventKind::kLiftoff, 1e-9));
  const auto& z = run.final_state;
  ASSERT_EQ(run.final_mode, Mode::kFlight);
  EXPECT_LT(std::hypot(z[6], z[7]), 1e-6);
  const double l = std::hypot(z[0] - z[4], z[1] - z[5]);
  const double lowest = z[4] > z[0] && q.law != Law::kStraightLeg ? 0.5 * (z[1] + z[5] - l) : z[5];
  EXPECT_NEAR(lowest, 0.0, 1e-9);
}

TEST_P(ToeMass, LandsAtTheAngleItsLegHasNotAtTheCommandedOne) {
  SimulationRequest q = WithToeMass(ToeMassRequest(GetParam()), 0.02, 12.0);  // a slow placement
  const Trajectory run = Simulate(EndedAfter(q, EventKind::kTouchdown, -1e-12, 2));
  ASSERT_EQ(run.final_mode, Mode::kFlight);
  const auto& z = run.final_state;
  const double u = z[4] - z[0], h = z[1] - z[5], theta = std::atan2(u, h);
  EXPECT_GT(std::abs(theta - q.parameters.theta_td), Degrees(1.0));
  const double lowest =
      theta > 0.0 && q.law != Law::kStraightLeg ? 0.5 * (z[1] + z[5] - std::hypot(u, h)) : z[5];
  EXPECT_NEAR(lowest, 0.0, 1e-11);
}

TEST_P(ToeMass, ChannelsShowTheSwingingLegAndTheWeightOfTheToe) {
  const SimulationRequest q = ToeMassRequest(GetParam());
  const std::array channels = {Channel::kLegAngle,     Channel::kLegLength, Channel::kGroundForceX,
                               Channel::kGroundForceY, Channel::kHipTorque, Channel::kContact};
  SimulationRequest flying = EndedAfter(q, EventKind::kLiftoff, 0.03);
  const std::array at = {flying.horizon};
  flying.row_times = at;
  flying.channels = channels;
  const Trajectory run = Simulate(flying);
  const auto& z = run.final_state;
  const double u = z[4] - z[0], h = z[1] - z[5], l = std::hypot(u, h), theta = std::atan2(u, h);
  const double turning = (h * (z[6] - z[2]) - u * (z[3] - z[7])) / (l * l);
  const auto& p = q.parameters;
  const double shown = theta > 0.0 && q.law != Law::kStraightLeg ? l * std::cos(theta / 2) : l;
  EXPECT_TRUE(MatrixNear(run.samples,
                         std::vector{theta, shown, 0.0, 0.0,
                                     p.kd_place * turning - p.kp_place * (p.theta_td - theta), 0.0},
                         1e-9));

  SimulationRequest standing = EndedAfter(q, EventKind::kTouchdown, 0.02);
  const std::array then = {standing.horizon};
  standing.row_times = then;
  standing.channels = channels;
  const double carried = Simulate(standing).samples[3];
  standing.parameters.m_toe = 0.0;  // the same stance: the first flight is the same
  EXPECT_NEAR(carried - Simulate(standing).samples[3], p.m_toe * p.g, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, ToeMass, ::testing::ValuesIn(kLegLaws),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

}  // namespace
}  // namespace hoplab
