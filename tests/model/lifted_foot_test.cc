// M122: a strong torque bends a leg that has just landed, and its foot is off the ground for some
// milliseconds. No ground pulls it back.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "model/effects/effect.h"
#include "tests/support/effect_requests.h"
#include "tests/support/gradient_check.h"

namespace hoplab {
namespace {

using namespace testing;

// A leg of 7 g under a motor that asks for more than a newton metre.
struct Driven {
  SimulationRequest request = RigRequest();
  std::array<EffectSetting, 2> effects = {Setting("leg_mass", 0.007),
                                          Setting("foot_coulomb_friction", 1.0)};

  explicit Driven(double kp = 2.0) {
    request.parameters.m = 1.27;
    request.parameters.E = 22e9;
    request.parameters.kp = kp;
    request.effects = effects;
    request.initial = {0.0, 0.3, 1.0, 0.0};
    request.horizon = 0.3;
  }
};

const Event* FirstOf(const Trajectory& run, EventKind kind) {
  for (const Event& e : run.events) {
    if (e.kind == kind) return &e;
  }
  return nullptr;
}

// Body and leg as one fall meanwhile: what the leg's own motion moves the body by is of the size of
// its share of the mass.
TEST(LiftedFoot, LeavesTheBodyToItsWeight) {
  const Driven driven;
  const Trajectory run = Simulate(driven.request);
  const Event *down = FirstOf(run, EventKind::kTouchdown), *press = FirstOf(run, EventKind::kPress);
  ASSERT_TRUE(down && press);
  const double lasted = press->time - down->time;
  EXPECT_GT(lasted, 1e-3);
  EXPECT_LT(lasted, 6e-3);
  constexpr double kLegMoves = 2.0;  // m/s, of a foot under that torque
  const double share = 0.007 / driven.request.parameters.m;
  EXPECT_NEAR(press->vy - down->vy_after, -driven.request.parameters.g * lasted, share * kLegMoves);
  EXPECT_NEAR(press->vx - down->vx_after, 0.0, 2.0 * share * kLegMoves);
}

// No force of the ground is reported meanwhile, one is thereafter.
TEST(LiftedFoot, IsSeenWithoutAForce) {
  Driven driven;
  const Trajectory run = Simulate(driven.request);
  const Event *down = FirstOf(run, EventKind::kTouchdown), *press = FirstOf(run, EventKind::kPress);
  ASSERT_TRUE(down && press);
  const std::array rows = {0.5 * (down->time + press->time), press->time + 2e-3};
  const std::array channels = {Channel::kGroundForceX, Channel::kGroundForceY};
  driven.request.row_times = rows;
  driven.request.channels = channels;
  const Trajectory seen = Simulate(driven.request);
  ASSERT_EQ(seen.samples.size(), 4u);
  EXPECT_EQ(seen.samples[0], 0.0);
  EXPECT_EQ(seen.samples[1], 0.0);
  EXPECT_GT(seen.samples[3], 1.0);
}

// Where it comes to press, lifted and pressed are one motion: nothing jumps.
TEST(LiftedFoot, ComesToPressWithoutAJump) {
  Driven driven;
  const Trajectory run = Simulate(driven.request);
  const Event* press = FirstOf(run, EventKind::kPress);
  ASSERT_TRUE(press);
  std::array<std::vector<double>, 2> rates;
  for (int after : {0, 1}) {
    driven.request.horizon = press->time + (after ? 1e-8 : -1e-8);
    rates[static_cast<std::size_t>(after)] = Simulate(driven.request).final_rate;
  }
  ASSERT_EQ(rates[0].size(), rates[1].size());
  ASSERT_FALSE(rates[0].empty());
  for (std::size_t i = 0; i < rates[0].size(); ++i)
    EXPECT_NEAR(rates[1][i], rates[0][i], 1e-4 * (1.0 + std::abs(rates[0][i]))) << i;
}

// The weaker the torque, the shorter; none lifts nothing.
TEST(LiftedFoot, IsLiftedByItsTorqueAlone) {
  double before = 1.0;
  for (const double kp : {2.0, 1.0, 0.2}) {
    const Trajectory run = Simulate(Driven(kp).request);
    const Event* press = FirstOf(run, EventKind::kPress);
    ASSERT_TRUE(press) << kp;
    const double lasted = press->time - FirstOf(run, EventKind::kTouchdown)->time;
    EXPECT_LT(lasted, 0.8 * before) << kp;
    before = lasted;
  }
  EXPECT_EQ(FirstOf(Simulate(Driven(0.0).request), EventKind::kPress), nullptr);
}

TEST(LiftedFoot, DerivativesMatchDifferences) {
  Driven driven;
  const Trajectory run = Simulate(driven.request);
  ASSERT_NE(FirstOf(run, EventKind::kPress), nullptr);
  const std::vector<double> times = TimesClearOfEvents(run);
  driven.request.row_times = times;
  driven.request.channels = ChannelsOf(Law::kElastica);
  const std::array directions = {
      SensitivityDirection::EffectParameter(0, 0), SensitivityDirection::EffectParameter(1, 0),
      SensitivityDirection::Parameter(ParameterId::kE),
      SensitivityDirection::Parameter(ParameterId::kKp), SensitivityDirection::InitialState(2)};
  driven.request.directions = directions;
  for (const ColumnCheck& check : CheckGradient(driven.request)) EXPECT_EQ(Complaint(check), "");
}

}  // namespace
}  // namespace hoplab
