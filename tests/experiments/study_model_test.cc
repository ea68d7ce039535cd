#include "experiments/identification/study_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/leg_stiffness.h"
#include "tests/experiments/study_hoppers.h"

namespace hoplab {
namespace {

using namespace testing;
using C = StudyConstant;

TEST(StudyModel, SlopesOfTheEnergyLeftMatchDifferences) {
  StudyHopper hopper = SomeHopperWithToe();
  hopper.integrator.relative_tolerance = 1e-11;
  hopper.integrator.absolute_tolerance = 1e-12;
  const EnergyCell cell{DegToRad(35.0), 3.0, 0.0};
  At(hopper.constants, C::kRollingBlend) = 0.3;
  StudySlopes slopes;
  ASSERT_TRUE(EnergyPercent(hopper, cell, &slopes).has_value());
  constexpr double kStep = 1e-4;
  for (int i = 0; i < kStudyConstantCount; ++i) {
    const auto c = static_cast<C>(i);
    StudyHopper above = hopper, below = hopper;
    At(above.constants, c) *= std::exp(kStep);
    At(below.constants, c) *= std::exp(-kStep);
    const double difference =
        (*EnergyPercent(above, cell) - *EnergyPercent(below, cell)) / (2.0 * kStep);
    EXPECT_NEAR(slopes[static_cast<std::size_t>(c)], difference,
                1e-5 * (1.0 + std::abs(difference)))
        << InfoOf(c).name;
  }
}

TEST(StudyModel, AJumpOfAMasslessLegDoesNotFeelWhatComesAfterIt) {
  const StudyHopper hopper = SomeHopper();
  const EnergyCell cell{DegToRad(35.0), 3.0, 0.0};
  for (int i = 0; i < kStudyConstantCount; ++i) {
    const auto c = static_cast<C>(i);
    StudyHopper other = hopper;
    At(other.constants, c) *= 1.1;
    const bool is_felt = *EnergyPercent(other, cell) != *EnergyPercent(hopper, cell);
    const bool is_zero = At(hopper.constants, c) == 0.0;  // and stays so
    EXPECT_EQ(is_felt, IsInEnergy(c) && !is_zero) << InfoOf(c).name;
  }
}

// The energy left goes to the massless leg's in proportion to the toe mass.
TEST(StudyModel, AVanishingToeMassLeavesTheMasslessLeg) {
  const EnergyCell cell{DegToRad(35.0), 3.0, 0.0};
  const double massless = *EnergyPercent(SomeHopper(), cell);
  const auto off = [&](double toe_mass) {
    StudyHopper hopper = SomeHopperWithToe();
    At(hopper.constants, C::kToeMass) = toe_mass;
    return *EnergyPercent(hopper, cell) - massless;
  };
  EXPECT_GT(std::abs(off(1e-3)), 0.01);
  EXPECT_NEAR(off(1e-3) / off(5e-4), 2.0, 0.2);
}

// Mass, toe mass, E I, gain and damping of one factor: the same motion, every stiffness times the
// factor. So table 6.5 alone cannot tell the mass from the scale of the damping.
TEST(StudyModel, ScalingMassStiffnessGainAndDampingChangesForcesAlone) {
  for (const StudyHopper& hopper : {SomeHopper(), SomeHopperWithToe()}) {
    StudyHopper heavier = hopper;
    for (const C c : {C::kMass, C::kToeMass, C::kBendingStiffness, C::kGain, C::kDampingScale})
      At(heavier.constants, c) *= 2.0;
    const EnergyCell cell{DegToRad(30.0), 3.0, 0.0};
    // The section's thickness goes with the cube root: axial and shear strain are not scaled alike.
    EXPECT_NEAR(*EnergyPercent(hopper, cell), *EnergyPercent(heavier, cell), 0.02);
    const ControlledSettings settings{.damping_N_s_per_m = 6.0};
    const ControlledRun one = RunControlled(hopper, settings, {.stiffness = true});
    const ControlledRun two = RunControlled(heavier, settings, {.stiffness = true});
    ASSERT_FALSE(std::isnan(one.k_max_N_per_m));
    EXPECT_NEAR(two.k_max_N_per_m / one.k_max_N_per_m, 2.0, 0.02);
    EXPECT_NEAR(two.k_min_N_per_m / one.k_min_N_per_m, 2.0, 0.02);
  }
}

TEST(StudyModel, LaterLandingsAreAtTheirShareOfTheFirstOnesAngle) {
  StudyHopper hopper = SomeHopper();
  const SimulationRequest request = ControlledRequest(hopper, {});
  EXPECT_DOUBLE_EQ(request.parameters.start_angle, DegToRad(40.0));
  EXPECT_DOUBLE_EQ(request.parameters.theta_td, 0.45 * DegToRad(40.0));
  // And only later landings: a first jump is the same at any share.
  const EnergyCell cell{DegToRad(35.0), 3.0, 0.0};
  const double before = *EnergyPercent(hopper, cell);
  At(hopper.constants, C::kPlacedShare) = 1.0;
  EXPECT_EQ(*EnergyPercent(hopper, cell), before);
}

TEST(StudyModel, StiffnessRangeHoldsTheUnloadedLegAtTouchdown) {
  const StudyHopper hopper = SomeHopper();
  const ControlledRun run = RunControlled(hopper, {.damping_N_s_per_m = 6.0}, {.stiffness = true});
  const SimulationRequest request = ControlledRequest(hopper, {});
  const double theta = request.parameters.theta_td, r = request.parameters.r;
  const double at_touchdown = StanceStiffness(request, theta, 2.0 * r * std::cos(0.5 * theta));
  EXPECT_LE(run.k_min_N_per_m, at_touchdown * (1.0 + 1e-4));
  EXPECT_GE(run.k_max_N_per_m, at_touchdown * (1.0 - 1e-4));
  EXPECT_LT(run.k_min_N_per_m, run.k_max_N_per_m);
}

TEST(StudyModel, ARunThatFallsIsMissingAndNotZero) {
  StudyHopper hopper = SomeHopper();
  At(hopper.constants, C::kMass) = 5.0;
  At(hopper.constants, C::kBendingStiffness) = 0.3;  // the body falls through the leg
  EXPECT_FALSE(EnergyPercent(hopper, {DegToRad(25.0), 0.0, 0.0}).has_value());
  const ControlledRun run = RunControlled(hopper, {}, {.stiffness = true});
  EXPECT_FALSE(IsComplete(run.outcome));
  EXPECT_TRUE(std::isnan(run.k_min_N_per_m));
  for (const ConvergenceReading& reading : AllConvergenceReadings())
    EXPECT_FALSE(run.TimeBy(reading).converged()) << NameOf(reading);
}

TEST(StudyData, ThePublishedTablesHaveTheirCells) {
  const StudyData data = PublishedStudyData();
  ASSERT_EQ(data.energy.size(), 15U);
  EXPECT_EQ(data.energy.front().percent, 103.12);
  ASSERT_EQ(data.modulus.size(), 20U);
  EXPECT_TRUE(std::isnan(data.modulus[3].k_min_N_per_m));  // 21.4 GPa, undamped: no convergence
  EXPECT_EQ(data.modulus.back().k_max_N_per_m, 6500.0);
  ASSERT_EQ(data.initial_states.size(), 50U);
  EXPECT_EQ(data.initial_states.front().convergence_time_s, 11.3);
  EXPECT_EQ(data.initial_states.back().convergence_time_s, 3.6);
}

TEST(StudyData, OneTableAloneHasItsCells) {
  const StudyData all = PublishedStudyData();
  EXPECT_EQ(OnlyTables(all, {StudyTableId::k61}).initial_states.size(), 25U);
  EXPECT_EQ(OnlyTables(all, {StudyTableId::k61}).initial_states.front().damping_N_s_per_m, 0.0);
  EXPECT_EQ(OnlyTables(all, {StudyTableId::k64}).modulus.size(), 10U);
  EXPECT_TRUE(OnlyTables(all, {StudyTableId::k64}).energy.empty());
  EXPECT_EQ(OnlyTables(all, {StudyTableId::k65, StudyTableId::k62}).energy.size(), 15U);
}

}  // namespace
}  // namespace hoplab
