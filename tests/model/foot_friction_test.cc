#include <gtest/gtest.h>

#include <array>

#include "model/effects/effect.h"
#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"

// A foot that slips away, M64.

namespace hoplab {
namespace {

using namespace testing;

// A leg that leaves on its toe, far behind the hip.
SimulationRequest LongPush(Law law) {
  SimulationRequest q = ExcitedRequest(law);
  q.parameters.kp = 0.0;
  if (law == Law::kStraightLeg) return q;
  q.parameters.theta_td = Degrees(8.0);
  q.initial = {0.0, 0.25, 1.6, -0.1};
  return q;
}

double LeadAtLiftoff(const SimulationRequest& asked, double before = 1e-9) {
  SimulationRequest q = asked;
  const Trajectory run = Simulate(q);
  for (const Event& e : run.events) {
    if (e.kind != EventKind::kLiftoff) continue;
    const std::vector<double> times = {e.time - before};
    const std::array channels = {Channel::kContactX, Channel::kBodyX, Channel::kBodyY};
    q.row_times = times;
    q.channels = channels;
    const Trajectory last = Simulate(q);
    return (last.samples[0] - last.samples[1]) / last.samples[2];
  }
  ADD_FAILURE() << "no lift-off";
  return 0.0;
}

TEST(FootFriction, EndsTheStanceWhereTheChordLeavesTheCone) {
  for (Law law : kAllLaws) {
    if (MechanismOf(law) != MechanismKind::kCLeg) continue;
    SimulationRequest q = LongPush(law);
    const double free = std::abs(LeadAtLiftoff(q));
    const double mu = 0.8 * free;
    const std::array effects = {Setting("foot_coulomb_friction", 1.0 / mu)};
    q.effects = effects;
    EXPECT_NEAR(std::abs(LeadAtLiftoff(q)), mu, 1e-7) << NameOf(law);
  }
}

TEST(FootFriction, ChangesNothingWhereItHolds) {
  for (Law law : {Law::kLargeDeflection, Law::kThesis, Law::kStraightLeg}) {
    SimulationRequest q = LongPush(law);
    const Trajectory plain = Simulate(q);
    const std::array effects = {Setting("foot_coulomb_friction", 0.9 / std::abs(LeadAtLiftoff(q)))};
    q.effects = effects;
    const Trajectory held = Simulate(q);
    EXPECT_EQ(EventNames(held), EventNames(plain));
    EXPECT_EQ(held.final_state, plain.final_state);
  }
}

TEST(FootFriction, LeavesNoSupportWhereTheLegLandsOutsideTheCone) {
  SimulationRequest q = ExcitedRequest(Law::kLargeDeflection);  // chord at 15 deg
  const std::array effects = {Setting("foot_coulomb_friction", 1.01 / std::tan(Degrees(15.0)))};
  q.effects = effects;
  EXPECT_EQ(Simulate(q).outcome, Outcome::kNoSupport);
}

TEST(FootFriction, DerivativesThroughTheSlipMatchDifferences) {
  for (Law law : {Law::kConsistent, Law::kLargeDeflection, Law::kNoSlip}) {
    SimulationRequest q = LongPush(law);
    const double mu = 0.8 * std::abs(LeadAtLiftoff(q));
    const std::array effects = {Setting("foot_coulomb_friction", 1.0 / mu)};
    q.effects = effects;
    const std::vector<double> times = TimesClearOfEvents(Simulate(q));
    q.row_times = times;
    q.channels = ChannelsOf(law);
    const std::array directions = {SensitivityDirection::EffectParameter(0, 0),
                                   SensitivityDirection::Parameter(ParameterId::kD),
                                   SensitivityDirection::InitialState(2)};
    q.directions = directions;
    for (const ColumnCheck& check : CheckGradient(q))
      EXPECT_EQ(Complaint(check), "") << NameOf(law);
  }
}

}  // namespace
}  // namespace hoplab
