#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>

#include "model/effects/effect.h"
#include "tests/support/effect_requests.h"

namespace hoplab {
namespace {

using namespace testing;

// A ball high in the air.
SimulationRequest HighBall() {
  SimulationRequest q = ExcitedRequest(Law::kBall);
  q.initial = {0.1, 500.0, 0.7, 0.4};
  q.horizon = 3.0;
  return q;
}
// A body on a leg, high in the air.
SimulationRequest HighLeg() {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.initial = {0.0, 100.0, 1.0, -1.0};
  q.horizon = 2.0;
  return q;
}

TEST(ConstantForce, BendsTheParabolaOfABall) {
  SimulationRequest q = HighBall();
  const std::array effects = {Setting("constant_force", 0.3)};
  q.effects = effects;
  const double t = q.horizon, a = 0.3 / q.parameters.m, g = q.parameters.g;
  const Trajectory run = Simulate(q);
  EXPECT_NEAR(run.final_state[0], 0.1 + 0.7 * t + 0.5 * a * t * t, 1e-11);
  EXPECT_NEAR(run.final_state[1], 500.0 + 0.4 * t - 0.5 * g * t * t, 1e-10);
  EXPECT_NEAR(run.final_state[2], 0.7 + a * t, 1e-12);
}

TEST(MagnusLift, SendsABallAlongACycloid) {
  SimulationRequest q = HighBall();
  const std::array effects = {Setting("magnus_lift", 0.4)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  // In v = vx + i vy: dv/dt = i (w v - g), w = c_m/m; it circles about the drift g/w.
  using namespace std::complex_literals;
  const double w = 0.4 / q.parameters.m, drift = q.parameters.g / w;
  const std::complex<double> v0(0.7, 0.4), turn = std::exp(1i * w * q.horizon);
  const std::complex<double> v = drift + (v0 - drift) * turn;
  const std::complex<double> z =
      std::complex<double>(0.1, 500.0) + drift * q.horizon + (v0 - drift) * (turn - 1.0) / (1i * w);
  EXPECT_NEAR(run.final_state[0], z.real(), 1e-10);
  EXPECT_NEAR(run.final_state[1], z.imag(), 1e-10);
  EXPECT_NEAR(run.final_state[2], v.real(), 1e-11);
  EXPECT_NEAR(run.final_state[3], v.imag(), 1e-11);
  EXPECT_NEAR(EnergyAtEnd(q, run) / Energy(q, Mode::kFlight, q.initial), 1.0, 1e-12);
}

TEST(BounceCoulombFriction, SlowsABallThatSlidesAndLetsItRollAtMost) {
  SimulationRequest q = ExcitedRequest(Law::kBall);
  q.initial[2] = -q.initial[2];
  q.parameters.tangential_loss = 0.0;
  const double restitution = q.parameters.restitution;
  // The impulse of Coulomb friction, mu m (1 + e) |vy|, turns a hollow ball that slides; it ends as
  // the ball rolls: m v+ + I v+/r^2 = m v-, with I = 2/3 m r^2, so v+ = 3/5 v-.
  for (const double mu : {0.002, 3.0, -0.002}) {
    const std::array effects = {Setting("bounce_coulomb_friction", mu)};
    q.effects = effects;
    const Trajectory run = Simulate(q);
    int bounces = 0;
    for (const Event& e : run.events) {
      if (e.kind != EventKind::kBounce) continue;
      ++bounces;
      ASSERT_LT(e.vx, 0.0);
      const double slides = e.vx + mu * (1.0 + restitution) * std::abs(e.vy);
      EXPECT_NEAR(e.vx_after, mu > 1.0 ? 0.6 * e.vx : slides, 1e-14) << mu;
      EXPECT_NEAR(e.vy_after, -restitution * e.vy, 1e-14);
    }
    EXPECT_GT(bounces, 2) << mu;
  }
}

TEST(RestitutionSpeed, ChangesRestitutionWithTheSpeedOfEachImpact) {
  SimulationRequest q = ExcitedRequest(Law::kBall);
  const std::array effects = {Setting("restitution_speed", -0.05)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  int bounces = 0;
  for (const Event& e : run.events) {
    if (e.kind != EventKind::kBounce) continue;
    ++bounces;
    EXPECT_NEAR(e.vy_after, -(0.8 - 0.05 * std::abs(e.vy)) * e.vy, 1e-14);
    EXPECT_EQ(e.vx_after, (1.0 - q.parameters.tangential_loss) * e.vx);
  }
  EXPECT_GE(bounces, 2);
}

TEST(GuideViscousFriction, LetsABodyFallTowardsItsTerminalSpeed) {
  SimulationRequest q = HighLeg();
  const std::array effects = {Setting("guide_viscous_friction", 2.0)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  const double rate = 2.0 / q.parameters.m, terminal = q.parameters.g / rate;
  EXPECT_NEAR(run.final_state[3], -terminal + (terminal - 1.0) * std::exp(-rate * q.horizon),
              1e-12);
  EXPECT_EQ(run.final_state[2], 1.0);
}

TEST(GuideCoulombFriction, TakesAConstantForceFromAFallingBody) {
  SimulationRequest q = HighLeg();
  const std::array effects = {Setting("guide_coulomb_friction", 0.5)};
  q.effects = effects;
  // At 1 m/s and more tanh(v/0.02 m/s) is 1 to the last digit.
  EXPECT_NEAR(Simulate(q).final_state[3], -1.0 - (q.parameters.g - 0.5) * q.horizon, 1e-12);
}

TEST(BoomInertia, SlowsFreeFallAndLeavesTheWeight) {
  SimulationRequest q = HighLeg();
  std::array effects = {Setting("boom_inertia", 0.5)};
  effects[0].values[1] = 0.25;
  q.effects = effects;
  const Trajectory run = Simulate(q);
  EXPECT_NEAR(run.final_state[3], -1.0 - q.parameters.g / 1.25 * q.horizon, 1e-12);
  EXPECT_NEAR(EnergyAtEnd(q, run) / Energy(q, Mode::kFlight, q.initial), 1.0, 1e-14);
}

TEST(GroundSlope, BouncesABallByTheNormalOfTheGround) {
  SimulationRequest q = ExcitedRequest(Law::kBall);
  const double slope = 0.3, c = std::cos(slope), s = std::sin(slope), g = q.parameters.g;
  const std::array effects = {Setting("ground_slope", slope)};
  q.effects = effects;
  q.parameters.tangential_loss = 0.0;
  q.horizon = 1.0;
  const Trajectory run = Simulate(q);
  // Gravity in the ground's frame has two constant parts; so has every flight.
  const auto turned = [&](double x, double y) { return std::array{c * x + s * y, c * y - s * x}; };
  const auto [x0, y0] = turned(q.initial[0], q.initial[1]);
  const auto [vx0, vy0] = turned(q.initial[2], q.initial[3]);
  const double height = y0 - q.parameters.radius, a = g * c;
  const double t = (vy0 + std::sqrt(vy0 * vy0 + 2.0 * a * height)) / a;
  const Event& bounce = First(run, EventKind::kBounce);
  EXPECT_NEAR(bounce.time, t, 1e-13);
  const auto [x, y] = turned(bounce.x, bounce.y);
  EXPECT_NEAR(x, x0 + vx0 * t - 0.5 * g * s * t * t, 1e-13);
  EXPECT_NEAR(y, q.parameters.radius, 1e-13);
  const auto [vx, vy] = turned(bounce.vx_after, bounce.vy_after);
  EXPECT_NEAR(vx, vx0 - g * s * t, 1e-13);
  EXPECT_NEAR(vy, -q.parameters.restitution * (vy0 - a * t), 1e-13);
  // In the world gravity is vertical.
  EXPECT_NEAR(run.final_rate[2], 0.0, 1e-14);
  EXPECT_NEAR(run.final_rate[3], -g, 1e-14);
}

TEST(GroundSlope, KeepsTheEnergyOfALegAndMeasuresItsAngleFromTheHorizontal) {
  for (Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica, Law::kStraightLeg}) {
    SimulationRequest q = ExcitedRequest(law);
    q.parameters.d = q.parameters.kp = 0.0;
    const std::array effects = {Setting("ground_slope", -0.06)};
    q.effects = effects;
    const std::vector<double> times = {0.001};
    const std::array channels = {Channel::kLegAngle, Channel::kBodyX, Channel::kBodyY};
    q.row_times = times;
    q.channels = channels;
    const Trajectory run = Simulate(q);
    ASSERT_EQ(run.outcome, Outcome::kHopLimit) << NameOf(law);
    EXPECT_NEAR(EnergyAtEnd(q, run) / Energy(q, Mode::kFlight, q.initial), 1.0, kEnergyDrift);
    EXPECT_NEAR(run.samples[0], q.parameters.theta_td, 1e-15);
    EXPECT_NEAR(run.samples[1], q.initial[0] + 0.001 * q.initial[2], 1e-14);
    // The hip lands where a leg at that angle meets the sloping ground.
    if (law != Law::kStraightLeg) continue;
    const Event& e = First(run, EventKind::kTouchdown);
    const double foot_x = e.x + q.parameters.l0 * std::sin(q.parameters.theta_td);
    const double foot_y = e.y - q.parameters.l0 * std::cos(q.parameters.theta_td);
    EXPECT_NEAR(foot_y, foot_x * std::tan(-0.06), 1e-12);
  }
}

TEST(ObservationEffects, ActInTheirOrderHoweverTheyAreGiven) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.channels = kBodyChannels;
  const double clock = 0.03, delay = 0.004, scale = 0.05, offset = 0.02, roll = 0.3, zoom = 0.1;
  std::vector<EffectSetting> effects = {
      Setting("camera_scale", zoom),      Setting("camera_roll", roll),
      Setting("clock_scale", clock),      Setting("sensor_delay", delay),
      Setting("sensor_offset_y", offset), Setting("sensor_scale_x", scale),
      Setting("sensor_scale_y", -scale),  Setting("sensor_offset_x", -offset)};
  const std::vector<double> stamps = {0.05, 0.11, 0.17, 0.23};
  q.row_times = stamps;
  q.effects = effects;
  const Trajectory seen = Simulate(q);
  std::reverse(effects.begin(), effects.end());
  EXPECT_EQ(Simulate(q).samples, seen.samples);

  std::vector<double> read;
  for (double t : stamps) read.push_back(t / (1.0 + clock) - delay);
  q.row_times = read;
  q.effects = {};
  const Trajectory real = Simulate(q);
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    const double* z = &real.samples[4 * row];
    const double x = z[0] * (1.0 + scale) - offset, y = z[1] * (1.0 - scale) + offset;
    const double c = (1.0 + zoom) * std::cos(roll), s = (1.0 + zoom) * std::sin(roll);
    EXPECT_NEAR(seen.samples[4 * row], c * x - s * y, 1e-14);
    EXPECT_NEAR(seen.samples[4 * row + 1], s * x + c * y, 1e-14);
    EXPECT_NEAR(seen.samples[4 * row + 2], c * z[2] - s * z[3], 1e-14);
    EXPECT_NEAR(seen.samples[4 * row + 3], s * z[2] + c * z[3], 1e-14);
  }
}

TEST(ClockScale, AtNullIsTheTimeTimesTheRateBackward) {
  SimulationRequest q = HighLeg();
  const std::vector<double> times = {1.5};
  const std::array effects = {Setting("clock_scale", 0.0)};
  const std::array directions = {SensitivityDirection::EffectParameter(0, 0)};
  q.row_times = times;
  q.channels = kBodyChannels;
  q.effects = effects;
  q.directions = directions;
  const Trajectory run = Simulate(q);
  EXPECT_NEAR(run.sensitivities[0], -1.5 * run.samples[2], 1e-13);
  EXPECT_NEAR(run.sensitivities[3], 1.5 * q.parameters.g, 1e-13);
}

// ---- hooks no effect of the catalogue uses yet ----

struct Trampoline {
  static constexpr std::array kParameters = {EffectParameter{"a", "-", 0.0, -1.0, 1.0, 0.1}};
  static constexpr EffectInfo kInfo = {.name = "trampoline",
                                       .kind = EffectKind::kGuard,
                                       .equation = "",
                                       .sentence = "",
                                       .for_legs = true,
                                       .for_ball = false,
                                       .dissipative = false,
                                       .parameters = kParameters};
  template <class T>
  static void ChangeContactHeight(const T* p, T& height) {
    height -= 0.1 * p[0];
  }
  template <class T>
  static void ChangeLiftoffVelocity(const T* p, const Landing<T>& leaving, Vector2<T>& velocity) {
    velocity.x += p[0] * leaving.chord.x;
    velocity.y += p[0] * leaving.chord.y;
  }
};

TEST(Hooks, OfContactHeightAndLiftoffAct) {
  static const Effect trampoline = MakeEffect<Trampoline>();
  for (Law law : {Law::kLargeDeflection, Law::kStraightLeg}) {
    SimulationRequest q = ExcitedRequest(law);
    const Event plain = First(Simulate(q), EventKind::kTouchdown);
    EffectSetting setting = EffectSetting::Null(trampoline);
    setting.values[0] = 0.2;
    q.effects = std::span(&setting, 1);
    const Trajectory run = Simulate(q);
    EXPECT_NEAR(First(run, EventKind::kTouchdown).y, plain.y - 0.02, 1e-12);
    const Event& up = First(run, EventKind::kLiftoff);
    EXPECT_NEAR(std::hypot(up.vx_after - up.vx, up.vy_after - up.vy), 0.2, 1e-12);
    EXPECT_GT(up.vy_after, up.vy);
  }
}

}  // namespace
}  // namespace hoplab
