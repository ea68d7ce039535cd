#include <gtest/gtest.h>

#include <array>

#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"
#include "tests/support/toe_mass.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

struct Case {
  std::string name;
  SimulationRequest request;
  std::string events;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> Cases() {
  std::vector<Case> cases;
  const std::string hop = "touchdown liftoff apex";
  for (const Law law : kLegLaws) {
    const std::string name(NameOf(law));
    SimulationRequest q = ToeMassRequest(law);
    q.max_hops = 2;
    // Placed slowly enough that the second landing still feels how.
    q = WithToeMass(q, 0.03, 40.0);
    cases.push_back({name + "_two_hops", q, hop + " " + hop});
    q.parameters.kp = 0.4;
    q.parameters.v_des = 1.4;
    cases.push_back({name + "_controlled", q, hop + " " + hop});
    if (law == Law::kStraightLeg) continue;
    // A heavy toe, so that its placement is seen in the apex already.
    q = WithToeMass(ToeMassRequest(law), 0.05, 60.0);
    q.parameters.theta_td = Degrees(8.0);
    q.initial[2] = 0.7;
    cases.push_back({name + "_rolling_toe", q, "touchdown rolling_to_toe liftoff apex"});
    q = WithToeMass(ToeMassRequest(law), 0.05, 60.0);
    q.parameters.theta_td = Degrees(-10.0);
    q.initial[2] = 0.3;
    cases.push_back({name + "_toe", q, hop});
    q = WithToeMass(ToeMassRequest(law), 0.05, 60.0);
    q.parameters.theta_td = Degrees(-2.0);
    q.initial = {0.0, 0.25, -0.5, -0.1};
    cases.push_back({name + "_toe_rolling", q, "touchdown toe_to_rolling liftoff apex"});
  }
  return cases;
}

std::vector<D> AllDirections(Law law) {
  std::vector<D> directions;
  for (ParameterId id : ToeParameters()) directions.push_back(D::Parameter(id));
  for (ParameterId id : ParametersOf(MechanismOf(law))) directions.push_back(D::Parameter(id));
  for (int i = 0; i < 4; ++i) directions.push_back(D::InitialState(i));
  return directions;
}

void ExpectAllPass(const std::vector<ColumnCheck>& checks) {
  ASSERT_FALSE(checks.empty());
  for (const ColumnCheck& check : checks) EXPECT_EQ(Complaint(check), "");
}

struct ToeMassGradient : ::testing::TestWithParam<Case> {};

TEST_P(ToeMassGradient, OfEveryParameterAndInitialStateMatchesDifferences) {
  SimulationRequest q = GetParam().request;
  const Trajectory run = Simulate(q);
  ASSERT_EQ(EventNames(run), GetParam().events);
  const std::vector<double> times = TimesClearOfEvents(run);
  const std::vector<D> directions = AllDirections(q.law);
  q.row_times = times;
  q.channels = ChannelsOf(q.law);
  q.directions = directions;
  ExpectAllPass(CheckGradient(q));
}

INSTANTIATE_TEST_SUITE_P(EveryLawAndSequence, ToeMassGradient, ::testing::ValuesIn(Cases()),
                         [](const auto& info) { return info.param.name; });

TEST(ToeMassGradientSeen, MassAndPlacementMoveTheSecondHop) {
  SimulationRequest q = Cases().front().request;
  const std::array directions = {D::Parameter(ParameterId::kToeMass),
                                 D::Parameter(ParameterId::kKpPlace),
                                 D::Parameter(ParameterId::kKdPlace)};
  q.directions = directions;
  const Trajectory run = Simulate(q);
  const std::array<double, 3> sizes = {q.parameters.m_toe, q.parameters.kp_place,
                                       q.parameters.kd_place};
  for (int k = 0; k < 3; ++k)
    EXPECT_GT(std::abs(run.final_sensitivities[2 * 3 + k] * sizes[k]), 1e-3) << k;
}

struct ToeMassEffects : ::testing::TestWithParam<Law> {
  SimulationRequest Request() const {
    SimulationRequest q = WithToeMass(ToeMassRequest(GetParam()), 0.03, 60.0);
    q.parameters.kp = 0.4;
    q.parameters.v_des = 1.4;
    return q;
  }
};

TEST_P(ToeMassEffects, ThatApplyHaveTheDerivativesOfDifferencesAtNullAndOff) {
  SimulationRequest q = Request();
  for (const Effect* effect : AllEffects()) {
    if (!AppliesTo(*effect, q.law, LegMass::kAtToe)) continue;
    for (const double share : {0.0, 0.3}) {
      SCOPED_TRACE(std::string(effect->info.name) + (share == 0.0 ? " at null" : " off null"));
      std::array effects = {EffectSetting::Null(*effect)};
      effects[0].values[0] += share * effect->info.parameters[0].typical;
      const std::array directions = {D::EffectParameter(0, 0), D::Parameter(ParameterId::kToeMass)};
      q.effects = effects;
      q.directions = std::span(directions).first(share == 0.0 ? 1 : 2);
      q.row_times = {};
      q.channels = {};
      const std::vector<double> times = TimesClearOfEvents(Simulate(q));
      q.row_times = times;
      q.channels = ChannelsOf(q.law);
      const Trajectory run = Simulate(q);
      ASSERT_EQ(run.outcome, Outcome::kHopLimit);
      ExpectAllPass(CheckGradient(q, run));
    }
  }
}

TEST_P(ToeMassEffects, AtNullChangeNothing) {
  SimulationRequest q = Request();
  const Trajectory plain = Simulate(q);
  for (const Effect* effect : AllEffects()) {
    if (!AppliesTo(*effect, q.law, LegMass::kAtToe)) continue;
    const std::array effects = {EffectSetting::Null(*effect)};
    q.effects = effects;
    EXPECT_EQ(Simulate(q).final_state, plain.final_state) << effect->info.name;
  }
}

INSTANTIATE_TEST_SUITE_P(TwoLaws, ToeMassEffects,
                         ::testing::Values(Law::kLargeDeflection, Law::kStraightLeg),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

TEST(ToeMassEffects, RefusedAreThoseThatAreNotModelled) {
  std::vector<std::string> refused;
  for (const Effect* effect : AllEffects()) {
    for (const Law law : kLegLaws) {
      if (AppliesTo(*effect, law) && !AppliesTo(*effect, law, LegMass::kAtToe)) {
        refused.emplace_back(effect->info.name);
        break;
      }
    }
  }
  EXPECT_EQ(refused,
            (std::vector<std::string>{"foot_coulomb_friction", "leg_mass", "rest_length_step",
                                      "sole_thickness", "torque_lag", "uneven_curvature"}));
}

}  // namespace
}  // namespace hoplab
