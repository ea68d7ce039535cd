#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "model/effects/effect.h"
#include "model/leg_compliance.h"
#include "tests/support/effect_requests.h"
#include "tests/support/moving_air.h"

namespace hoplab {
namespace {

using namespace testing;

SimulationRequest RequestOf(Law law) {
  SimulationRequest q = law == Law::kBall          ? BallRequest()
                        : law == Law::kStraightLeg ? SteadyStraightLeg()
                                                   : ThickLegRequest(law);
  q.channels = kBodyChannels;
  return q;
}

TEST(EffectRegistry, ListsEveryEffectByName) {
  std::vector<std::string> names;
  for (const Effect* effect : AllEffects()) names.emplace_back(effect->info.name);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const char* name : {"air_drag", "gravity_scale", "sensor_delay", "touchdown_angle_bias"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  for (const std::string& name : names) EXPECT_EQ(FindEffect(name)->info.name, name);
  EXPECT_EQ(FindEffect("warp_drive"), nullptr);
}

TEST(EffectRegistry, SaysWhereEachEffectActs) {
  EXPECT_EQ(FindEffect("air_drag")->info.kind, EffectKind::kForce);
  EXPECT_EQ(FindEffect("gravity_scale")->info.kind, EffectKind::kParameter);
  EXPECT_EQ(FindEffect("touchdown_angle_bias")->info.kind, EffectKind::kGuard);
  EXPECT_EQ(FindEffect("sensor_delay")->info.kind, EffectKind::kObservation);
}

TEST(EffectRegistry, HoldsForEveryParameterANullInsideItsBoundsAndATypicalSize) {
  for (const Effect* effect : AllEffects()) {
    ASSERT_FALSE(effect->info.parameters.empty()) << effect->info.name;
    EXPECT_FALSE(effect->info.sentence.empty());
    EXPECT_FALSE(effect->info.equation.empty());
    for (const EffectParameter& p : effect->info.parameters) {
      EXPECT_LE(p.lower, p.null);
      EXPECT_LE(p.null, p.upper);
      EXPECT_LT(p.lower, p.upper);
      EXPECT_GT(p.typical, 0.0);
      EXPECT_EQ(effect->FindParameter(p.name), &p - effect->info.parameters.data());
    }
    EXPECT_FALSE(effect->FindParameter("warp").has_value());
    EXPECT_TRUE(EffectSetting::Null(*effect).IsNull());
  }
}

// A search leaves alone what is about a part that no trial has.
TEST(EffectRegistry, SaysWhatPartOfAMachineAnEffectIsAbout) {
  for (const Effect* effect : AllEffects()) {
    const EffectInfo& info = effect->info;
    const MachinePart about = info.name.starts_with("gait_")     ? MachinePart::kClock
                              : info.name.starts_with("guide_")  ? MachinePart::kGuideOfBall
                              : info.name == "torque_limit_loss" ? MachinePart::kTorqueLimit
                              : info.name == "camera_scale"      ? MachinePart::kTwoAxes
                              : info.name == "wind"              ? MachinePart::kTwoAxes
                                                                 : MachinePart::kNone;
    EXPECT_EQ(info.about, about) << info.name;
    const bool of_motors = about == MachinePart::kClock || about == MachinePart::kTorqueLimit;
    const bool of_robots_alone = info.for_robot && !info.for_legs && !info.for_ball;
    EXPECT_TRUE(!of_motors || of_robots_alone) << info.name;
  }
}

TEST(EffectAtNull, ChangesNothingBitForBit) {
  for (Law law : kAllLaws) {
    SimulationRequest q = ExcitedRequest(law);
    const auto times = EvenTimes(0.5, 100);
    q.row_times = times;
    q.channels = ChannelsOf(law);
    const Trajectory without = Simulate(q);
    for (const Effect* effect : AllEffects()) {
      // Of what the law has in itself null is another model (driven_elastica_test.cc).
      if (!AppliesTo(*effect, law) || IsPartOf(law, *effect)) continue;
      SCOPED_TRACE(std::string(NameOf(law)) + " " + std::string(effect->info.name));
      const std::array effects = {EffectSetting::Null(*effect)};
      q.effects = effects;
      const Trajectory with = Simulate(q);
      ASSERT_EQ(with.samples.size(), without.samples.size());
      for (std::size_t i = 0; i < with.samples.size(); ++i) {
        if (std::isnan(without.samples[i]))
          EXPECT_TRUE(std::isnan(with.samples[i]));
        else
          EXPECT_EQ(with.samples[i], without.samples[i]);
      }
      ASSERT_EQ(with.events.size(), without.events.size());
      for (std::size_t i = 0; i < with.events.size(); ++i)
        EXPECT_EQ(with.events[i].time, without.events[i].time);
      EXPECT_EQ(with.final_state, without.final_state);
    }
  }
}

TEST(EffectWithAThreshold, ShowsBesideAnEffectThatIsThere) {
  int found = 0;
  for (const Effect* effect : AllEffects()) {
    if (effect->info.shows_beside.empty()) continue;
    ++found;
    EXPECT_NE(FindEffect(effect->info.shows_beside), nullptr) << effect->info.name;
  }
  EXPECT_GT(found, 0);
}

TEST(EffectOffNull, ChangesTheSamples) {
  for (Law law : kAllLaws) {
    SimulationRequest q = ExcitedRequest(law);
    const auto times = EvenTimes(1.0, 40);
    q.row_times = times;
    q.channels = kBodyChannels;
    const Trajectory without = Simulate(q);
    for (const Effect* effect : AllEffects()) {
      if (!AppliesTo(*effect, law) || effect->info.has_threshold) continue;
      std::array effects = {EffectSetting::Null(*effect)};
      effects[0].values[0] += effect->info.parameters[0].typical;
      EXPECT_FALSE(effects[0].IsNull());
      q.effects = effects;
      EXPECT_NE(Simulate(q).samples, without.samples) << NameOf(law) << ' ' << effect->info.name;
    }
  }
}

TEST(DissipativeEffects, NeverCreateEnergy) {
  for (Law law :
       {Law::kConsistent, Law::kLargeDeflection, Law::kElastica, Law::kStraightLeg, Law::kBall}) {
    SimulationRequest q = RequestOf(law);
    q.parameters.d = 0.0;
    q.max_hops = 0;
    for (const Effect* effect : AllEffects()) {
      if (!effect->info.dissipative || !AppliesTo(*effect, law)) continue;
      std::array effects = {EffectSetting::Null(*effect)};
      effects[0].values[0] += effect->info.parameters[0].typical;
      q.effects = effects;
      q.horizon = 0.0;
      double last = Energy(q, Mode::kFlight, q.initial);
      const double first = last;
      // Through flight and stance alike, strain energy counted.
      for (double t = 0.02; t < 0.6; t += 0.02) {
        q.horizon = t;
        const Trajectory run = Simulate(q);
        const double energy = Energy(q, run.final_mode, run.final_state);
        EXPECT_LE(energy, last + kEnergyDrift * first) << NameOf(law) << " at " << t;
        last = energy;
      }
      if (!effect->info.has_threshold) {
        EXPECT_LT(last, first) << NameOf(law);
      }
    }
  }
}

TEST(GravityScale, IsAnotherGravity) {
  SimulationRequest q = RequestOf(Law::kLargeDeflection);
  std::array effects = {EffectSetting::Null(*FindEffect("gravity_scale"))};
  effects[0].values[0] = -0.1;
  q.effects = effects;
  const Trajectory scaled = Simulate(q);
  q.effects = {};
  q.parameters.g *= 0.9;
  EXPECT_EQ(Simulate(q).final_state, scaled.final_state);
}

TEST(TouchdownAngleBias, IsAnotherTouchdownAngle) {
  SimulationRequest q = RequestOf(Law::kLargeDeflection);
  std::array effects = {EffectSetting::Null(*FindEffect("touchdown_angle_bias"))};
  effects[0].values[0] = 0.05;
  q.effects = effects;
  const Trajectory biased = Simulate(q);
  q.effects = {};
  q.parameters.theta_td += 0.05;
  EXPECT_EQ(Simulate(q).final_state, biased.final_state);
}

TEST(LegMaterialDamping, OnAStraightLegIsItsDamper) {
  SimulationRequest q = RequestOf(Law::kStraightLeg);
  std::array effects = {EffectSetting::Null(*FindEffect("leg_material_damping"))};
  effects[0].values[0] = 2e-3;
  q.effects = effects;
  const Trajectory material = Simulate(q);
  q.effects = {};
  q.parameters.d = 2e-3 * q.parameters.k;
  const Trajectory damper = Simulate(q);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(material.final_state[i], damper.final_state[i], 1e-11);
}

TEST(LegMaterialDamping, OnTheToeIsADamperOfItsStiffnessThere) {
  // A leg that lands on its toe and leaves from it has one stiffness, k(pi).
  SimulationRequest q = RequestOf(Law::kConsistent);
  q.parameters.d = 0.0;
  q.parameters.theta_td = Degrees(-10.0);
  q.initial = {0.0, 0.25, 0.3, -0.1};
  std::array effects = {EffectSetting::Null(*FindEffect("leg_material_damping"))};
  effects[0].values[0] = 1e-3;
  q.effects = effects;
  const Trajectory material = Simulate(q);
  q.effects = {};
  q.parameters.d = 1e-3 / LegCompliance<double>(q.parameters).Chord(std::numbers::pi);
  const Trajectory damper = Simulate(q);
  ASSERT_EQ(material.events.size(), damper.events.size());
  for (const Event& e : material.events) {
    EXPECT_NE(e.mode_before, Mode::kRolling);
    EXPECT_NE(e.mode_after, Mode::kRolling);
  }
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(material.final_state[i], damper.final_state[i], 1e-11);
}

TEST(TouchdownLoss, TakesItsShareOfTheSpeedAlongTheChordAndNoneAcross) {
  SimulationRequest q = RequestOf(Law::kLargeDeflection);
  std::array effects = {EffectSetting::Null(*FindEffect("touchdown_loss"))};
  effects[0].values[0] = 0.2;
  q.effects = effects;
  const Trajectory run = Simulate(q);
  const auto landing = std::find_if(run.events.begin(), run.events.end(),
                                    [](const Event& e) { return e.kind == EventKind::kTouchdown; });
  ASSERT_NE(landing, run.events.end());
  const double alpha = 0.5 * q.parameters.theta_td;  // chord angle of an unloaded rolling leg
  const double ex = -std::sin(alpha), ey = std::cos(alpha);
  EXPECT_NEAR(landing->vx_after * ex + landing->vy_after * ey,
              0.8 * (landing->vx * ex + landing->vy * ey), 1e-13);
  EXPECT_NEAR(landing->vx_after * ey - landing->vy_after * ex, landing->vx * ey - landing->vy * ex,
              1e-13);
}

TEST(SensorDelay, ReadsRowsEarlier) {
  SimulationRequest q = RequestOf(Law::kLargeDeflection);
  const std::vector<double> times = {0.05, 0.1, 0.15, 0.2};
  q.row_times = times;
  std::array effects = {EffectSetting::Null(*FindEffect("sensor_delay"))};
  effects[0].values[0] = 0.01;
  q.effects = effects;
  const Trajectory delayed = Simulate(q);
  std::vector<double> earlier = times;
  for (double& t : earlier) t -= 0.01;
  q.effects = {};
  q.row_times = earlier;
  EXPECT_EQ(Simulate(q).samples, delayed.samples);
}

TEST(AirDrag, OnAFallingBallReachesTheTerminalSpeed) {
  SimulationRequest q = RequestOf(Law::kBall);
  q.initial = {0.0, 500.0, 0.0, 0.0};
  q.horizon = 6.0;
  std::array effects = {EffectSetting::Null(*FindEffect("air_drag"))};
  effects[0].values[0] = 0.2;
  q.effects = effects;
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  const Trajectory run = Simulate(q);
  // v = v_t tanh(g t/v_t), v_t^2 = m g/c.
  const double terminal = std::sqrt(q.parameters.m * q.parameters.g / 0.2);
  EXPECT_NEAR(run.final_state[3], -terminal * std::tanh(q.parameters.g * 6.0 / terminal), 1e-10);
}

TEST(Wind, AndDragAreTheDragInMovingAir) {
  constexpr double kDrag = 0.01, kSeconds = 2.0;
  const std::array<double, 4> start = {0.0, 500.0, 1.0, -4.0};
  SimulationRequest q = RequestOf(Law::kBall);
  q.initial = {start[0], start[1], start[2], start[3]};
  q.horizon = kSeconds;
  q.integrator.relative_tolerance = kOracleRelative;
  q.integrator.absolute_tolerance = kOracleAbsolute;
  std::array effects = {EffectSetting::Null(*FindEffect("air_drag")),
                        EffectSetting::Null(*FindEffect("wind"))};
  effects[0].values[0] = kDrag;
  q.effects = effects;
  const auto off = [&](double w, double told) {
    effects[1].values[0] = kDrag * w;
    effects[1].values[1] = told;
    const Trajectory run = Simulate(q);
    const testing::BallInMovingAir air{
        .drag = kDrag, .wind = w, .mass = q.parameters.m, .g = q.parameters.g};
    const std::array<double, 4> exact = air.At({kSeconds}, start).front();
    return std::hypot(run.final_state[0] - exact[0], run.final_state[1] - exact[1]);
  };
  for (const double w : {-3.0, 0.4, 8.0}) EXPECT_LT(off(w, w), 1e-7) << w;
  EXPECT_GT(off(0.0, 0.0) + off(0.4, 0.0), 1e-4);
  EXPECT_NEAR(off(0.4, 0.0) / off(0.2, 0.0), 4.0, 0.4);  // the first order in w
}

}  // namespace
}  // namespace hoplab
