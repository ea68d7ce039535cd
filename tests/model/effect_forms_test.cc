#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <complex>

#include "model/effects/effect.h"
#include "tests/support/effect_requests.h"

namespace hoplab {
namespace {

using namespace testing;

constexpr std::array kBody = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx, Channel::kBodyVy};

const Event& First(const Trajectory& run, EventKind kind) {
  return *std::find_if(run.events.begin(), run.events.end(),
                       [&](const Event& e) { return e.kind == kind; });
}
double EnergyAtEnd(const SimulationRequest& q, const Trajectory& run) {
  return Energy(q, run.final_mode, run.final_state);
}

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

TEST(HipViscousFriction, AnswersToTheRateOfTheLegAngle) {
  for (Law law : kAllLaws) {
    if (law == Law::kBall) continue;
    for (double theta : {30.0, 8.0, -10.0}) {
      SimulationRequest q = ExcitedRequest(law);
      q.parameters.kp = 0.0;
      if (law != Law::kStraightLeg) {
        q.parameters.theta_td = Degrees(theta);
        q.initial = {0.0, 0.25, 0.7, -0.1};
      }
      const double b_h = 0.02, step = 1e-4;
      const std::array effects = {Setting("hip_viscous_friction", b_h)};
      q.effects = effects;
      const Trajectory whole = Simulate(q);
      std::vector<double> times;
      for (double t : TimesClearOfEvents(whole)) {
        if (t < First(whole, EventKind::kTouchdown).time) continue;
        if (t > First(whole, EventKind::kLiftoff).time) break;
        for (double shift : {-2.0, -1.0, 0.0, 1.0, 2.0}) times.push_back(t + shift * step);
      }
      ASSERT_GE(times.size(), 10u);
      const std::array channels = {Channel::kHipTorque, Channel::kLegAngle};
      q.row_times = times;
      q.channels = channels;
      const Trajectory run = Simulate(q);
      const auto angle = [&](std::size_t row) { return run.samples[2 * row + 1]; };
      for (std::size_t i = 2; i < times.size(); i += 5) {
        const double rate =
            (8.0 * (angle(i + 1) - angle(i - 1)) - (angle(i + 2) - angle(i - 2))) / (12.0 * step);
        EXPECT_NEAR(run.samples[2 * i], b_h * rate, 1e-6 * b_h * (1.0 + std::abs(rate)))
            << NameOf(law) << ' ' << theta;
      }
    }
  }
}

TEST(HipViscousFriction, TakesFromTheBodyWhatItsTorqueDoesAcrossTheChord) {
  for (Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kElastica, Law::kStraightLeg}) {
    SimulationRequest q = ExcitedRequest(law);
    q.parameters.d = q.parameters.kp = 0.0;
    const double b_h = law == Law::kStraightLeg ? 5.0 : 0.02;
    const std::array effects = {Setting("hip_viscous_friction", b_h)};
    q.effects = effects;
    // Ended a moment before lift-off, so that what the leg holds counts.
    Trajectory run = Simulate(q);
    const double begin = First(run, EventKind::kTouchdown).time;
    q.horizon = First(run, EventKind::kLiftoff).time - 1e-12;
    using Rule = boost::math::quadrature::gauss<double, 20>;
    constexpr int kPanels = 40;
    std::vector<double> times;
    for (int panel = 0; panel < kPanels; ++panel) {
      const double half = 0.5 * (q.horizon - begin) / kPanels,
                   middle = begin + (2 * panel + 1) * half;
      for (std::size_t i = Rule::abscissa().size(); i-- > 0;)
        times.push_back(middle - half * Rule::abscissa()[i]);
      for (double x : Rule::abscissa()) times.push_back(middle + half * x);
    }
    const std::array channels = {Channel::kHipTorque, Channel::kBodyX,  Channel::kBodyY,
                                 Channel::kBodyVx,    Channel::kBodyVy, Channel::kContactX};
    q.row_times = times;
    q.channels = channels;
    run = Simulate(q);
    double lost = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const std::size_t place = i % 20, node = place < 10 ? 9 - place : place - 10;
      const double* row = &run.samples[channels.size() * i];
      const double torque = row[0], u = row[5] - row[1], y = row[2];
      const double turning = (y * row[3] + u * row[4]) / (u * u + y * y);
      lost -= 0.5 * (q.horizon - begin) / kPanels * Rule::weights()[node] * torque * turning;
    }
    const double start = Energy(q, Mode::kFlight, q.initial);
    EXPECT_GT(lost, 1e-5 * start) << NameOf(law);
    EXPECT_NEAR(start - EnergyAtEnd(q, run), lost, 1e-8 * start) << NameOf(law);
  }
}

TEST(HipFriction, HoldsBackALegThatGoesForward) {
  for (const char* name : {"hip_viscous_friction", "hip_coulomb_friction"}) {
    SimulationRequest q = ExcitedRequest(Law::kLargeDeflection);
    q.parameters.kp = 0.0;
    const std::vector<double> times = {0.14};
    const std::array channels = {Channel::kHipTorque};
    q.row_times = times;
    q.channels = channels;
    const std::array effects = {Setting(name, 0.01)};
    q.effects = effects;
    EXPECT_LT(Simulate(q).samples[0], -0.005) << name;
  }
}

TEST(LegHysteresis, TakesTheSameShareHoweverStiffTheLeg) {
  // A vertical hop of a straight leg: eta of the spring's work is lost going down, and coming up.
  SimulationRequest q = SteadyStraightLeg();
  q.parameters.theta_td = 0.0;
  q.initial = {0.0, 1.3, 0.0, -1.0};
  const std::array effects = {Setting("leg_hysteresis", 0.1)};
  q.effects = effects;
  for (double k : {1e4, 4e4}) {
    q.parameters.k = k;
    const Trajectory run = Simulate(q);
    const double down = Energy(q, Mode::kFlight, q.initial);
    const double up = EnergyAtEnd(q, run);
    // Greatest compression: (1 + eta) k D^2/2 = kinetic energy there + m g D, and back.
    const double m = 100.0, g = 10.0, eta = 0.1;
    const double e0 = down - m * g * 1.0, load = 0.5 * k * (1.0 + eta);
    const double D = (m * g + std::sqrt(m * g * m * g + 4.0 * load * e0)) / (2.0 * load);
    EXPECT_NEAR(down - up, 2.0 * eta * 0.5 * k * D * D, 2e-3 * (down - up)) << k;
  }
}

TEST(LegQuadraticDamping, IsADamperWhoseConstantIsItsSpeed) {
  const Effect& effect = *FindEffect("leg_quadratic_damping");
  const double d2 = 3.0;
  for (double w : {-0.7, 0.4}) {
    double force = 0.0;
    effect.hooks0.add_chord_force(
        &d2, {.elastic_force = 1.0, .stiffness = 1.0, .rate = w, .compression = 0.1}, force);
    EXPECT_DOUBLE_EQ(force, -d2 * std::abs(w) * w);
  }
}

TEST(TorqueLag, FollowsTheCommandByItsTimeConstant) {
  SimulationRequest q = ExcitedRequest(Law::kLargeDeflection);
  const double lag = 0.02, step = 1e-4;
  const std::array effects = {Setting("torque_lag", lag)};
  q.effects = effects;
  const double touchdown = First(Simulate(q), EventKind::kTouchdown).time;
  const std::vector<double> times = {touchdown + 1e-9, touchdown + 0.02 - step, touchdown + 0.02,
                                     touchdown + 0.02 + step};
  const std::array channels = {Channel::kHipTorque, Channel::kBodyVx};
  q.row_times = times;
  q.channels = channels;
  const Trajectory run = Simulate(q);
  const auto torque = [&](int row) { return run.samples[2 * row]; };
  const auto command = [&](int row) {
    return q.parameters.kp * (q.parameters.v_des - run.samples[2 * row + 1]);
  };
  EXPECT_NEAR(torque(0), command(0), 1e-7);
  EXPECT_NEAR((torque(3) - torque(1)) / (2.0 * step), (command(2) - torque(2)) / lag, 1e-4);
  EXPECT_GT(std::abs(command(2) - torque(2)), 1e-3);
  EXPECT_EQ(run.final_state.size(), 5u);
}

TEST(TorqueLag, TooShortToIntegrateMeetsTheIntegratedOne) {
  for (Law law : {Law::kLargeDeflection, Law::kStraightLeg}) {
    SimulationRequest q = ExcitedRequest(law);
    std::array effects = {Setting("torque_lag", 0.9999e-5)};
    q.effects = effects;
    const Trajectory quick = Simulate(q);
    effects[0].values[0] = 1.0001e-5;
    const Trajectory integrated = Simulate(q);
    EXPECT_GT(integrated.steps, 5 * quick.steps);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(quick.final_state[i], integrated.final_state[i], 1e-8);
  }
}

TEST(RestLengthStep, PutsInTheWorkOfItsPush) {
  SimulationRequest q = SteadyStraightLeg();
  const double dl = 0.01;
  const std::array effects = {Setting("rest_length_step", dl)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(EventNames(run), "touchdown max_compression liftoff apex");
  const Event& down = First(run, EventKind::kTouchdown);
  const Event& turn = First(run, EventKind::kMaxCompression);
  const double foot = down.x + q.parameters.l0 * std::sin(q.parameters.theta_td);
  const double ux = turn.x - foot, length = std::hypot(ux, turn.y);
  EXPECT_NEAR((ux * turn.vx + turn.y * turn.vy) / length, 0.0, 1e-11);
  const double deflection = q.parameters.l0 - length;
  const double work = q.parameters.k * (deflection * dl + 0.5 * dl * dl);
  EXPECT_NEAR(EnergyAtEnd(q, run) - Energy(q, Mode::kFlight, q.initial), work, 1e-9 * 1e3);
  // It is the unstretched leg that lands again.
  q.max_hops = 2;
  const Trajectory again = Simulate(q);
  int landings = 0;
  for (const Event& e : again.events) {
    if (e.kind != EventKind::kTouchdown) continue;
    ++landings;
    EXPECT_NEAR(e.y, q.parameters.l0 * std::cos(q.parameters.theta_td), 1e-12);
  }
  EXPECT_EQ(landings, 2);
}

TEST(TouchdownAngleSpeed, PlacesTheLegByTheSpeedOfTheMoment) {
  SimulationRequest q = ExcitedRequest(Law::kStraightLeg);
  const std::array effects = {Setting("touchdown_angle_speed", 0.1)};
  q.effects = effects;
  const Trajectory run = Simulate(q);
  const Event& e = First(run, EventKind::kTouchdown);
  const double theta = q.parameters.theta_td + 0.1 * (e.vx - 1.0);
  EXPECT_NEAR(e.y, q.parameters.l0 * std::cos(theta), 1e-12);
}

TEST(ObservationEffects, ActInTheOrderClockDelayScaleOffsetRollHoweverTheyAreGiven) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  q.channels = kBody;
  const double clock = 0.03, delay = 0.004, scale = 0.05, offset = 0.02, roll = 0.3;
  std::vector<EffectSetting> effects = {
      Setting("camera_roll", roll),       Setting("clock_scale", clock),
      Setting("sensor_delay", delay),     Setting("sensor_offset_y", offset),
      Setting("sensor_scale_x", scale),   Setting("sensor_scale_y", -scale),
      Setting("sensor_offset_x", -offset)};
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
    const double c = std::cos(roll), s = std::sin(roll);
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
  q.channels = kBody;
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
