#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// A law driven through a sequence of events.
struct Case {
  std::string name;
  SimulationRequest request;
  std::string events;  // what the run must go through
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> Cases() {
  std::vector<Case> cases;
  const std::string rolling = "touchdown liftoff apex";
  const std::string to_toe = "touchdown rolling_to_toe liftoff apex";
  for (Law law : kCLegLaws) {
    const std::string name(NameOf(law));
    SimulationRequest q = ThickLegRequest(law);
    cases.push_back({name + "_rolling", q, rolling});

    q = ThickLegRequest(law);
    q.parameters.theta_td = Degrees(8.0);
    q.initial[2] = 0.7;
    cases.push_back({name + "_rolling_toe", q, to_toe});

    q = ThickLegRequest(law);
    q.parameters.theta_td = Degrees(-10.0);
    q.initial[2] = 0.3;
    cases.push_back({name + "_toe", q, rolling});

    q = ThickLegRequest(law);
    q.parameters.theta_td = Degrees(-2.0);
    q.initial = {0.0, 0.25, -0.5, -0.1};
    cases.push_back({name + "_toe_rolling", q, "touchdown toe_to_rolling liftoff apex"});

    q = ThickLegRequest(law);
    q.parameters.theta_td = Degrees(24.0);
    q.initial = {0.0, 0.25, 0.8, 0.1};
    q.max_hops = 3;
    cases.push_back({name + "_three_hops", q, "apex " + rolling + " " + rolling + " " + rolling});

    q = ThickLegRequest(law);
    q.parameters.kp = 0.6;
    q.parameters.v_des = 1.6;
    cases.push_back({name + "_controlled", q, rolling});

    q = ThickLegRequest(law);
    q.parameters.kp = 2.5;
    q.parameters.v_des = 1.5;
    q.parameters.torque_limit = 1.3;
    cases.push_back({name + "_torque_limit", q, ""});

    q = ThickLegRequest(law);
    q.liftoff = LiftoffRule::kRestLength;
    cases.push_back({name + "_rest_length", q, rolling});
  }
  {
    SimulationRequest q = SteadyStraightLeg();
    q.initial[3] = -0.1;
    q.parameters.d = 60.0;
    cases.push_back({"straight_leg_hop", q, rolling});
    q.max_hops = 3;
    q.parameters.kp = 20.0;
    q.parameters.v_des = 0.5;
    cases.push_back(
        {"straight_leg_three_hops_controlled", q, rolling + " " + rolling + " " + rolling});
    q = SteadyStraightLeg();
    q.initial[3] = -0.1;
    q.liftoff = LiftoffRule::kRestLength;
    q.parameters.d = 60.0;
    cases.push_back({"straight_leg_rest_length", q, rolling});
    q = SteadyStraightLeg();
    q.initial[3] = -0.1;
    q.parameters.d = 60.0;
    q.parameters.kp = 200.0;
    q.parameters.v_des = 0.6;
    q.parameters.torque_limit = 14.0;
    cases.push_back({"straight_leg_torque_limit", q, ""});
    q = BallRequest();
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    q.horizon = 2.2;
    cases.push_back({"ball", q, ""});
  }
  return cases;
}

std::vector<D> AllDirections(Law law) {
  std::vector<D> directions;
  for (ParameterId id : ParametersOf(MechanismOf(law))) directions.push_back(D::Parameter(id));
  for (int i = 0; i < 4; ++i) directions.push_back(D::InitialState(i));
  return directions;
}

void ExpectAllPass(const std::vector<ColumnCheck>& checks) {
  ASSERT_FALSE(checks.empty());
  for (const ColumnCheck& check : checks) EXPECT_EQ(Complaint(check), "");
}

double WorstError(const std::vector<ColumnCheck>& checks) {
  double worst = 0.0;
  for (const ColumnCheck& c : checks) {
    if (!c.nothing_to_see) worst = std::max(worst, c.error);
  }
  return worst;
}

// The events of a request alone.
Trajectory SimulateWithoutRows(SimulationRequest request) {
  request.row_times = {};
  request.channels = {};
  request.directions = {};
  return Simulate(request);
}

class Gradient : public ::testing::TestWithParam<Case> {
 protected:
  // With rows over the whole run but none so near an event that the differences straddle it, and
  // every channel; the ground force of a damped leg jumps at touch-down.
  void SetUp() override {
    request_ = GetParam().request;
    const Trajectory run = Simulate(request_);
    ASSERT_TRUE(IsComplete(run.outcome)) << NameOf(run.outcome) << ": " << EventNames(run);
    if (!GetParam().events.empty()) {
      ASSERT_EQ(EventNames(run), GetParam().events);
    }
    times_ = TimesClearOfEvents(run);
    request_.row_times = times_;
    request_.channels = ChannelsOf(request_.law);
  }
  // Where the torque meets its limit almost tangentially, differences do not get through with a
  // lag, whose layers ask for steps far below its time constant.
  bool BeyondDifferences(const Effect& effect) const {
    return effect.info.name == "torque_lag" && std::isfinite(request_.parameters.torque_limit);
  }
  SimulationRequest request_;
  std::vector<double> times_;
};

TEST_P(Gradient, OfEveryParameterAndInitialStateMatchesDifferences) {
  const auto directions = AllDirections(request_.law);
  request_.directions = directions;
  const auto checks = CheckGradient(request_);
  ExpectAllPass(checks);
  RecordProperty("worst_error", std::to_string(WorstError(checks)));
}

TEST_P(Gradient, OfEveryEffectAtNullMatchesDifferences) {
  for (const Effect* effect : AllEffects()) {
    if (!AppliesTo(*effect, request_.law) || BeyondDifferences(*effect)) continue;
    SCOPED_TRACE(effect->info.name);
    const std::array effects = {EffectSetting::Null(*effect)};
    const std::array directions = {D::EffectParameter(0, 0)};
    request_.effects = effects;
    request_.directions = directions;
    ExpectAllPass(CheckGradient(request_));
  }
}

TEST_P(Gradient, OfEveryEffectOffNullMatchesDifferences) {
  for (const Effect* effect : AllEffects()) {
    if (!AppliesTo(*effect, request_.law) || BeyondDifferences(*effect)) continue;
    SCOPED_TRACE(effect->info.name);
    std::array effects = {EffectSetting::Null(*effect)};
    effects[0].values[0] += 0.3 * effect->info.parameters[0].typical;
    const std::array directions = {D::EffectParameter(0, 0), D::InitialState(1)};
    request_.effects = effects;
    request_.directions = directions;
    // The effect moves the events, and may move the last one before a row.
    const std::vector<double> times = TimesClearOfEvents(SimulateWithoutRows(request_));
    request_.row_times = times;
    ExpectAllPass(CheckGradient(request_));
  }
}

INSTANTIATE_TEST_SUITE_P(EveryLawAndSequence, Gradient, ::testing::ValuesIn(Cases()),
                         [](const auto& info) { return info.param.name; });

TEST(GradientTorqueLimit, RunsOfTheCasesReachTheLimit) {
  for (const Case& c : Cases()) {
    if (c.name.find("torque_limit") == std::string::npos) continue;
    EXPECT_NE(EventNames(Simulate(c.request)).find("torque_limit"), std::string::npos) << c.name;
  }
}

TEST(GradientEffects, OfAllEffectsTogetherMatchesDifferences) {
  SimulationRequest q = ThickLegRequest(Law::kLargeDeflection);
  std::vector<EffectSetting> effects;
  std::vector<D> directions;
  for (const Effect* effect : AllEffects()) {
    if (!AppliesTo(*effect, q.law)) continue;
    effects.push_back(EffectSetting::Null(*effect));
    effects.back().values[0] += 0.3 * effect->info.parameters[0].typical;
    directions.push_back(D::EffectParameter(static_cast<int>(effects.size()) - 1, 0));
  }
  for (const D& d : AllDirections(q.law)) directions.push_back(d);
  q.effects = effects;
  q.directions = directions;
  const std::vector<double> times = TimesClearOfEvents(SimulateWithoutRows(q));
  q.row_times = times;
  q.channels = ChannelsOf(q.law);
  ExpectAllPass(CheckGradient(q));
}

TEST(GradientCheck, ReportsADerivativeThatIsWrong) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  const auto directions = AllDirections(q.law);
  q.directions = directions;
  Trajectory wrong = Simulate(q);
  const std::size_t width = directions.size();
  // dy/dE at the end off by a ten thousandth.
  wrong.final_sensitivities[1 * width + 0] *= 1.0 + 1e-4;
  // The derivative of the touch-down time by theta_td: M16 forgotten.
  const std::size_t theta =
      std::find_if(directions.begin(), directions.end(),
                   [](const D& d) {
                     return d.of == D::Of::kParameter && d.parameter == ParameterId::kThetaTd;
                   }) -
      directions.begin();
  wrong.event_time_sensitivities[0 * width + theta] = 0.0;
  std::vector<std::string> complaints;
  for (const ColumnCheck& check : CheckGradient(q, wrong)) {
    if (!Complaint(check).empty()) complaints.push_back(check.what);
  }
  EXPECT_EQ(complaints, (std::vector<std::string>{"final state d/dE", "event times d/dtheta_td"}));
}

}  // namespace
}  // namespace hoplab
