#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "model/effects/effect.h"
#include "model/laws/elastic_arc.h"
#include "model/mechanisms/c_leg.h"
#include "model/mechanisms/legged_body_inl.h"
#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"

// The foot of a leg with mass, where the ground is slippery: M87.

namespace hoplab {
namespace {

using namespace testing;

constexpr std::array kLaws = {Law::kElastica, Law::kLargeDeflection, Law::kConsistent,
                              Law::kThesis,   Law::kNoSlip,          Law::kStraightLeg};

// A drop forward onto a leg of a twentieth of the mass.
struct Slippery {
  SimulationRequest request;
  std::array<EffectSetting, 2> effects;

  Slippery(Law law, double mu, double leg_share = 0.05) {
    request = ExcitedRequest(law);
    request.parameters.kp = request.parameters.d = 0.0;
    if (law != Law::kStraightLeg) {
      request.parameters.theta_td = Degrees(25.0);
      request.initial = {0.0, 0.3, 1.1, -0.1};
    }
    effects = {Setting("leg_mass", leg_share * request.parameters.m),
               Setting("foot_coulomb_friction", 1.0 / mu)};
    request.effects = effects;
  }
};

const Event* Find(const Trajectory& run, EventKind kind) {
  for (const Event& e : run.events) {
    if (e.kind == kind) return &e;
  }
  return nullptr;
}

// A foot that slides from landing to lift-off has felt mu times the impulse of the ground: what
// gravity gave and what the body's vertical velocity changed by, the blow included.
TEST(SlidingFoot, TakesMuOfTheGroundsImpulseAlong) {
  double worst = 0.0;
  for (const Law law : kLaws) {
    for (const double mu : {1e-9, 0.02, 0.05}) {
      for (const double d : {0.0, 2.0}) {
        Slippery s(law, mu);
        s.request.parameters.d = d;
        const Trajectory run = Simulate(s.request);
        const Event *down = Find(run, EventKind::kTouchdown), *up = Find(run, EventKind::kLiftoff);
        ASSERT_TRUE(down && up) << NameOf(law) << ' ' << mu;
        ASSERT_EQ(Find(run, EventKind::kStick), nullptr) << NameOf(law) << ' ' << mu;
        const double upward =
            up->vy_after - down->vy + s.request.parameters.g * (up->time - down->time);
        const double off = (up->vx_after - down->vx) + mu * upward;
        worst = std::max(worst, std::abs(off));
        EXPECT_NEAR(off, 0.0, 1e-8) << NameOf(law) << ' ' << mu << ' ' << d;
      }
    }
  }
  std::printf("  momentum along the ground off by %.1e m/s at most\n", worst);
}

template <class LegT>
struct OnIce : ::testing::Test {};
using SlidingLegs = ::testing::Types<CLeg<double, ConsistentLaw>, CLeg<double, LargeDeflectionLaw>>;
TYPED_TEST_SUITE(OnIce, SlidingLegs);

// On ice nothing is lost from the blow on: an integrator of others on the equations of motion.
TYPED_TEST(OnIce, KeepsItsEnergy) {
  using State = std::array<double, 6>;  // hip, its velocity, contact, speed of the foot
  Parameters<double> p = ThickLegRequest(Law::kConsistent).parameters;
  p.d = 0.0;
  LawTerms<double>& terms = p.law_terms;
  terms.active = terms.slopes_active = terms.leg_mass_active = terms.foot_friction_active = true;
  terms.leg_mass = 0.1 * p.m;
  terms.foot_friction = 1e12;
  LeggedBody<double, TypeParam> body({.parameters = p});
  ASSERT_EQ(body.size(), 6);
  State z = {0.3, p.r * (1.0 + std::cos(p.theta_td)), 0.9, -1.2, 0.0, 0.0};
  const Mode stance = body.Reset(Mode::kFlight, 0, 0.0, z.data()).next;
  const double foot = z[5];
  EXPECT_GT(foot, 0.5);
  const double landed = body.Energy(stance, z.data());
  boost::numeric::odeint::runge_kutta_fehlberg78<State> step;
  constexpr double kStep = 2e-5;
  for (int i = 0; i < 1000; ++i) {
    step.do_step([&](const State& at, State& rate,
                     double t) { body.Derivative(stance, t, at.data(), rate.data()); },
                 z, i * kStep, kStep);
  }
  EXPECT_GT(std::abs(z[5] - foot), 0.01) << "the foot answers to the leg";
  EXPECT_NEAR(body.Energy(stance, z.data()) / landed, 1.0, kEnergyDrift);
}

// Where it lands it slides, comes to hold, and then the stance is that of a foot that holds.
TEST(SlidingFoot, ComesToHold) {
  int compared = 0;
  for (const Law law : kLaws) {
    if (law == Law::kStraightLeg) continue;  // this one's blow lies within the cone
    const double mu = 0.4;
    Slippery s(law, mu);
    s.request.parameters.d = 1.0;
    const Trajectory run = Simulate(s.request);
    const Event *down = Find(run, EventKind::kTouchdown), *stick = Find(run, EventKind::kStick),
                *up = Find(run, EventKind::kLiftoff);
    ASSERT_TRUE(down && stick && up) << NameOf(law);
    EXPECT_LT(stick->time, down->time + 0.3 * (up->time - down->time)) << NameOf(law);
    // A firmer grip holds sooner, and a firm one from the start, as without the effect.
    const Trajectory firmer = [&] {
      Slippery f(law, 1.2 * mu);
      f.request.parameters.d = 1.0;
      return Simulate(f.request);
    }();
    if (const Event* sooner = Find(firmer, EventKind::kStick)) {
      ++compared;
      EXPECT_LT(sooner->time - down->time, stick->time - down->time) << NameOf(law);
    }
    Slippery firm(law, 1e5);
    const Trajectory holds = Simulate(firm.request);
    firm.request.effects = std::span(firm.effects).first(1);
    const Trajectory plain = Simulate(firm.request);
    EXPECT_EQ(Find(holds, EventKind::kStick), nullptr) << NameOf(law);
    ASSERT_EQ(holds.final_state.size(), plain.final_state.size());
    for (std::size_t i = 0; i < plain.final_state.size(); ++i)
      EXPECT_NEAR(holds.final_state[i], plain.final_state[i], 1e-7) << NameOf(law) << ' ' << i;
  }
  EXPECT_GE(compared, 3);
}

// A cause that is only asked for, at null, does not change the run it is asked of.
TEST(SlidingFoot, IsTheSameBesideATorqueThatIsNone) {
  for (const double mu : {0.1, 0.3, 0.5}) {
    Slippery s(Law::kElastica, mu);
    const std::array channels = {Channel::kBodyX, Channel::kBodyY};
    const std::vector<double> times = EvenTimes(Simulate(s.request).end_time - 1e-6, 50);
    s.request.row_times = times;
    s.request.channels = channels;
    const Trajectory alone = Simulate(s.request);
    const std::array with = {s.effects[0], s.effects[1], Setting("hip_viscous_friction", 0.0),
                             Setting("torque_bias", 0.0)};
    s.request.effects = with;
    const std::array directions = {SensitivityDirection::EffectParameter(2, 0),
                                   SensitivityDirection::EffectParameter(3, 0)};
    s.request.directions = directions;
    const Trajectory beside = Simulate(s.request);
    EXPECT_EQ(EventNames(beside), EventNames(alone)) << mu;
    ASSERT_EQ(beside.samples.size(), alone.samples.size());
    for (std::size_t i = 0; i < alone.samples.size(); ++i)
      EXPECT_NEAR(beside.samples[i], alone.samples[i], 1e-9) << mu;
  }
}

// A run that begins on a foot that its torque pushes out of the cone begins with a slide.
TEST(SlidingFoot, SlidesFromTheStartWhereATorquePushesIt) {
  Slippery s(Law::kElastica, 0.3);
  s.request.initial = {0.0, 0.165, 0.5, 0.1, 0.02};
  s.request.start_mode = Mode::kStance;
  s.request.horizon = 0.03;
  const Trajectory holds = Simulate(s.request);
  ASSERT_FALSE(holds.final_state.empty());
  s.request.parameters.v_des = 3.0;
  // Five times that torque bends the leg beyond its law, so there it does not bend it (M120).
  const std::array stiff = {s.effects[0], s.effects[1], Setting("torque_bending", 0.0)};
  for (const double kp : {1.0, 5.0}) {
    s.request.parameters.kp = kp;
    if (kp > 1.0) s.request.effects = stiff;
    const Trajectory slides = Simulate(s.request);
    EXPECT_EQ(Find(slides, EventKind::kSlide), nullptr) << "it slides already";
    ASSERT_FALSE(slides.final_state.empty());
    EXPECT_GT(std::abs(slides.final_state[kContact] - holds.final_state[kContact]), 1e-3) << kp;
  }
}

// A driven leg of the rig (datasets/rig-controlled). Near lift-off its foot may leave the cone and
// turn back within a microsecond, while the chord force ends too: it lifts off all the same, and no
// leg is left standing that pulls on the ground.
TEST(SlidingFoot, LiftsOffWhereASlideHardlyBegins) {
  SimulationRequest q = RigRequest();
  Parameters<double>& p = q.parameters;
  p.m = 1.01;
  p.E = 22.59e9;
  p.d = 1.808;
  p.kp = 2.0;
  const std::array effects = {Setting("leg_mass", 0.01262), Setting("torque_bending", 1.107),
                              Setting("foot_coulomb_friction", 0.4)};
  q.effects = effects;
  q.horizon = 1.64;
  for (int i = -20; i < 20; ++i) {
    q.initial = {2.9e-5, 0.3001, 1.007 + 0.003 * i, -0.00125};
    const Trajectory run = Simulate(q);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << NameOf(run.outcome) << ' ' << q.initial[2];
    int down = 0, up = 0;
    for (const Event& e : run.events) {
      down += e.kind == EventKind::kTouchdown;
      up += e.kind == EventKind::kLiftoff;
    }
    EXPECT_EQ(down, 5);
    EXPECT_EQ(up, down);
  }
}

// Where a leg lands does not depend on whether its torque bends it.
TEST(TorqueBending, LeavesTheFootWhereItLands) {
  SimulationRequest q = ExcitedRequest(Law::kElastica);
  q.parameters.kp = 5.0;
  q.parameters.v_des = q.initial[2] + 1.0;
  q.parameters.theta_td = Degrees(25.0);
  q.initial = {0.0, 0.3, 1.1, -0.1};
  const std::array effects = {Setting("torque_bending", 1.0)};
  q.effects = effects;
  const Trajectory whole = Simulate(q);
  const Event* down = Find(whole, EventKind::kTouchdown);
  ASSERT_TRUE(down);
  q.horizon = down->time + 1e-9;
  const Trajectory landed = Simulate(q);
  const double x = q.initial[0] + q.initial[2] * down->time;
  const double theta = q.parameters.theta_td, r = q.parameters.r;
  ASSERT_FALSE(landed.final_state.empty());
  EXPECT_NEAR(landed.final_state[kContact],
              x + r * std::sin(theta) - r * (std::numbers::pi - theta), 1e-8);
}

// M64 is its limit: the lighter the foot, the sooner it is away once the chord leaves the cone.
TEST(SlidingFoot, SlipsAwayAtOnceWithoutMass) {
  SimulationRequest q = ExcitedRequest(Law::kElastica);
  q.parameters.kp = 0.0;
  q.parameters.theta_td = Degrees(8.0);
  q.initial = {0.0, 0.25, 1.6, -0.1};
  const double mu = 0.3;
  const auto flight = [&](double leg_share) {
    const std::array effects = {Setting("leg_mass", leg_share * q.parameters.m),
                                Setting("foot_coulomb_friction", 1.0 / mu)};
    SimulationRequest with = q;
    with.effects = effects;
    const Trajectory run = Simulate(with);
    const Event* up = Find(run, EventKind::kLiftoff);
    EXPECT_TRUE(up) << leg_share;
    return up ? std::array{up->time, up->vx_after} : std::array{0.0, 0.0};
  };
  const auto limit = flight(0.99e-4);  // lighter feet have no inertia
  double before = 1.0;
  for (const double share : {1.6e-2, 4e-3, 1e-3}) {
    const auto at = flight(share);
    const double off = at[0] - limit[0];
    std::printf("  leg of %.4f of the mass: away %.2e s later\n", share, off);
    EXPECT_GT(off, 0.0);
    EXPECT_LT(off, 0.75 * before) << share;  // with the root of the mass
    before = off;
  }
}

// A foot that holds, leaves its cone late and slides away.
TEST(SlidingFoot, DerivativesThroughALateSlideMatchDifferences) {
  for (const Law law : {Law::kElastica, Law::kConsistent, Law::kNoSlip}) {
    Slippery s(law, 0.3, 0.016);
    s.request.parameters.d = 1.0;
    s.request.parameters.theta_td = Degrees(8.0);
    s.request.initial = {0.0, 0.25, 1.6, -0.1};
    const Trajectory run = Simulate(s.request);
    ASSERT_NE(Find(run, EventKind::kSlide), nullptr) << NameOf(law);
    const std::vector<double> times = TimesClearOfEvents(run);
    s.request.row_times = times;
    s.request.channels = ChannelsOf(law);
    const std::array directions = {SensitivityDirection::EffectParameter(0, 0),
                                   SensitivityDirection::EffectParameter(1, 0),
                                   SensitivityDirection::Parameter(ParameterId::kThetaTd),
                                   SensitivityDirection::InitialState(2)};
    s.request.directions = directions;
    for (const ColumnCheck& check : CheckGradient(s.request))
      EXPECT_EQ(Complaint(check), "") << NameOf(law);
  }
}

TEST(SlidingFoot, DerivativesMatchDifferences) {
  for (const Law law : kLaws) {
    for (const double mu : {0.05, 0.4}) {
      Slippery s(law, mu);
      s.request.parameters.d = 1.0;
      s.request.parameters.kp = 0.5;
      s.request.parameters.v_des = 1.5;
      const std::vector<double> times = TimesClearOfEvents(Simulate(s.request));
      s.request.row_times = times;
      s.request.channels = ChannelsOf(law);
      const std::array directions = {SensitivityDirection::EffectParameter(0, 0),
                                     SensitivityDirection::EffectParameter(1, 0),
                                     SensitivityDirection::Parameter(ParameterId::kD),
                                     SensitivityDirection::Parameter(ParameterId::kThetaTd),
                                     SensitivityDirection::InitialState(2)};
      s.request.directions = directions;
      for (const ColumnCheck& check : CheckGradient(s.request))
        EXPECT_EQ(Complaint(check), "") << NameOf(law) << ' ' << mu;
    }
  }
}

}  // namespace
}  // namespace hoplab
