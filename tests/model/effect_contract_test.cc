#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "model/effects/effect.h"
#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// What every effect of the catalogue promises, under every law it applies to.
struct Contract {
  const Effect* effect;
  Law law;
};
void PrintTo(const Contract& c, std::ostream* out) { *out << NameOf(c.law) << c.effect->info.name; }

std::vector<Contract> Contracts() {
  std::vector<Contract> contracts;
  for (const Effect* effect : AllEffects()) {
    for (Law law : kAllLaws) {
      if (AppliesTo(*effect, law)) contracts.push_back({effect, law});
    }
  }
  return contracts;
}

class EffectContract : public ::testing::TestWithParam<Contract> {
 protected:
  void SetUp() override {
    effects_ = {EffectSetting::Null(*GetParam().effect)};
    request_ = ExcitedRequest(GetParam().law);
    const Trajectory run = Simulate(request_);
    ASSERT_TRUE(IsComplete(run.outcome)) << NameOf(run.outcome);
    times_ = TimesClearOfEvents(run);
    request_.row_times = times_;
    request_.channels = ChannelsOf(request_.law);
    request_.effects = effects_;
    for (std::size_t i = 0; i < GetParam().effect->info.parameters.size(); ++i)
      directions_.push_back(D::EffectParameter(0, static_cast<int>(i)));
    request_.directions = directions_;
  }
  SimulationRequest request_;
  std::array<EffectSetting, 1> effects_;
  std::vector<double> times_;
  std::vector<D> directions_;
};

TEST_P(EffectContract, DerivativesAtNullMatchDifferencesAndAreSeen) {
  const auto checks = CheckGradient(request_);
  ASSERT_EQ(checks.size(), 3 * directions_.size());
  for (std::size_t i = 0; i < checks.size(); i += 3) {
    for (std::size_t part = 0; part < 3; ++part) EXPECT_EQ(Complaint(checks[i + part]), "");
    const EffectInfo& info = GetParam().effect->info;
    EXPECT_EQ(checks[i].nothing_to_see, info.has_threshold || info.parameters[i / 3].is_of_first)
        << checks[i].what;
  }
}

TEST_P(EffectContract, DerivativesOffNullMatchDifferences) {
  for (std::size_t i = 0; i < GetParam().effect->info.parameters.size(); ++i)
    effects_[0].values[i] += 0.3 * GetParam().effect->info.parameters[i].typical;
  for (const ColumnCheck& check : CheckGradient(request_)) EXPECT_EQ(Complaint(check), "");
}

TEST_P(EffectContract, IsTheSameUnderEveryIntegrator) {
  for (std::size_t i = 0; i < GetParam().effect->info.parameters.size(); ++i)
    effects_[0].values[i] += GetParam().effect->info.parameters[i].typical;
  request_.directions = {};
  const Trajectory reference = Simulate(request_);
  request_.integrator.kind = IntegratorKind::kErkStep;
  const Trajectory other = Simulate(request_);
  ASSERT_EQ(EventNames(other), EventNames(reference));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(other.final_state[i], reference.final_state[i], 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EffectContract, ::testing::ValuesIn(Contracts()),
                         [](const auto& info) {
                           return std::string(info.param.effect->info.name) + "_" +
                                  std::string(NameOf(info.param.law));
                         });

// ---- look-alikes: effects that are, by construction, other values of what is there already ----

struct LookAlike {
  std::string name;
  Law law;
  std::string effect;
  double value;
  std::function<void(SimulationRequest&)> instead;
  bool positions_only = false;
};
void PrintTo(const LookAlike& c, std::ostream* out) { *out << c.name; }

constexpr double kMu = 0.07;  // size of the effects below

// A leg, its forces changed by a factor.
void ScaleForces(SimulationRequest& q, double factor) {
  for (double* p :
       {&q.parameters.E, &q.parameters.G, &q.parameters.k, &q.parameters.d, &q.parameters.kp})
    *p *= factor;
}

std::vector<LookAlike> LookAlikes() {
  std::vector<LookAlike> all;
  for (Law law :
       {Law::kThesis, Law::kNoSlip, Law::kConsistent, Law::kLargeDeflection, Law::kStraightLeg}) {
    const auto add = [&](const char* effect, auto instead, bool positions_only = false) {
      all.push_back({std::string(effect) + "_" + std::string(NameOf(law)), law, effect, kMu,
                     instead, positions_only});
    };
    add("body_mass_scale", [](SimulationRequest& q) { ScaleForces(q, 1.0 / (1.0 + kMu)); });
    add("boom_inertia", [](SimulationRequest& q) {
      ScaleForces(q, 1.0 / (1.0 + kMu));
      q.parameters.g /= 1.0 + kMu;
    });
    add("gravity_scale", [](SimulationRequest& q) { q.parameters.g *= 1.0 + kMu; });
    add("torque_gain", [](SimulationRequest& q) { q.parameters.kp *= 1.0 + kMu; });
    add("torque_bias", [](SimulationRequest& q) { q.parameters.v_des += kMu / q.parameters.kp; });
    add("touchdown_angle_bias", [](SimulationRequest& q) { q.parameters.theta_td += kMu; });
    add("sensor_offset_x", [](SimulationRequest& q) { q.initial[0] += kMu; });
    // Seconds a little longer: speeds, and forces per mass, in the new unit.
    add(
        "clock_scale",
        [](SimulationRequest& q) {
          const double rate = 1.0 / (1.0 + kMu);
          ScaleForces(q, rate * rate);
          q.parameters.d /= rate;
          q.parameters.kp /= rate;
          q.parameters.g *= rate * rate;
          for (double* v : {&q.initial[2], &q.initial[3], &q.parameters.v_des}) *v *= rate;
        },
        true);
    // The start, so much earlier in its flight.
    add("sensor_delay", [](SimulationRequest& q) {
      q.initial[0] -= kMu * q.initial[2];
      q.initial[1] -= kMu * q.initial[3] + 0.5 * kMu * kMu * q.parameters.g;
      q.initial[3] += kMu * q.parameters.g;
    });
    if (AppliesTo(*FindEffect("rest_radius_scale"), law))
      add("rest_radius_scale", [](SimulationRequest& q) { q.parameters.r *= 1.0 + kMu; });
    if (law == Law::kStraightLeg)
      add("rest_length_scale", [](SimulationRequest& q) { q.parameters.l0 *= 1.0 + kMu; });
    if (law == Law::kStraightLeg)
      add("leg_material_damping",
          [](SimulationRequest& q) { q.parameters.d += kMu * q.parameters.k; });
  }
  return all;
}

class ExactLookAlike : public ::testing::TestWithParam<LookAlike> {};

TEST_P(ExactLookAlike, CannotBeToldFromItsOther) {
  const LookAlike& c = GetParam();
  SimulationRequest q = ExcitedRequest(c.law);
  q.max_hops = 0;
  q.horizon = 0.6;
  const std::vector<double> times = EvenTimes(0.4, 40);
  const std::array channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx,
                               Channel::kBodyVy};
  q.row_times = times;
  q.channels = std::span(channels).first(c.positions_only ? 2 : 4);
  const Trajectory plain = Simulate(q);
  std::array effects = {EffectSetting::Null(*FindEffect(c.effect))};
  for (double& value : effects[0].values) value = c.value;
  q.effects = effects;
  const Trajectory with = Simulate(q);
  q.effects = {};
  c.instead(q);
  const Trajectory other = Simulate(q);
  ASSERT_EQ(with.samples.size(), other.samples.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < with.samples.size(); ++i) {
    if (std::isnan(with.samples[i]) && std::isnan(other.samples[i])) continue;  // has fallen
    EXPECT_NEAR(with.samples[i], other.samples[i], 1e-9) << i;
    largest = std::fmax(largest, std::abs(with.samples[i] - plain.samples[i]));
  }
  EXPECT_GT(largest, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ExactLookAlike, ::testing::ValuesIn(LookAlikes()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace hoplab
