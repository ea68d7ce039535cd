#include "experiments/identification/identification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "experiments/leg_stiffness.h"
#include "fitting/least_squares.h"
#include "optimize/box_search.h"

namespace hoplab {
namespace {

using C = StudyConstant;

StudyHopper SomeHopper() {
  StudyHopper hopper;
  hopper.constants = {0.8, 0.09, 6.0, 2.5, 0.9, 1.0, 0.0, 0.0};
  return hopper;
}

// The print of another study: what a hopper does, for settings of table 6.5 and a row of 6.4, to
// the digits the study prints or one more.
StudyData TablesOf(const StudyHopper& truth) {
  StudyData data;
  for (double deg : {25.0, 35.0, 45.0}) {
    for (double d : {0.0, 3.0, 6.0}) data.energy.push_back({DegToRad(deg), d, std::nan("")});
  }
  for (EnergyCell& cell : data.energy)
    cell.percent = std::round(*EnergyPercent(truth, cell) * 100.0) / 100.0;
  const ControlledRun run = RunControlled(truth, {.damping_N_s_per_m = 6.0});
  data.modulus.push_back({22e9, 6.0, run.convergence.time,
                          std::round(run.k_min_N_per_m / 10.0) * 10.0,
                          std::round(run.k_max_N_per_m / 10.0) * 10.0});
  return data;
}

IdentificationRequest RequestFor(const StudyData& data, std::vector<StudyReading> readings) {
  IdentificationRequest request;
  request.data = data;
  request.readings = std::move(readings);
  request.free = {C::kMass, C::kRadius, C::kBendingStiffness, C::kGain, C::kStartSpeed};
  request.fixed = {1.0, 0.1, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0};
  request.budget = 400;
  request.keep = 2;
  request.keep_to_the_end = 1;
  return request;
}

TEST(StudyModel, SlopesOfTheEnergyLeftMatchDifferences) {
  StudyHopper hopper = SomeHopper();
  hopper.integrator.relative_tolerance = 1e-11;
  hopper.integrator.absolute_tolerance = 1e-12;
  const EnergyCell cell{DegToRad(35.0), 3.0, 0.0};
  At(hopper.constants, C::kRollingBlend) = 0.3;
  At(hopper.constants, C::kToeMass) = 0.02;
  StudySlopes slopes;
  ASSERT_TRUE(EnergyPercent(hopper, cell, &slopes).has_value());
  constexpr double kStep = 1e-4;
  for (const C c : {C::kMass, C::kRadius, C::kBendingStiffness, C::kStartSpeed, C::kDampingScale,
                    C::kRollingBlend, C::kToeMass}) {
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

// The energy left goes to the massless leg's in proportion to the toe mass.
TEST(StudyModel, AVanishingToeMassLeavesTheMasslessLeg) {
  const EnergyCell cell{DegToRad(35.0), 3.0, 0.0};
  const double massless = *EnergyPercent(SomeHopper(), cell);
  const auto off = [&](double toe_mass) {
    StudyHopper hopper = SomeHopper();
    At(hopper.constants, C::kToeMass) = toe_mass;
    return *EnergyPercent(hopper, cell) - massless;
  };
  EXPECT_GT(std::abs(off(2e-3)), 0.01);
  EXPECT_NEAR(off(2e-3) / off(1e-3), 2.0, 0.2);
}

// Mass, E I, gain and damping of one factor: the same motion, every stiffness times the factor. So
// table 6.5 alone cannot tell the mass from the scale of the damping.
TEST(StudyModel, ScalingMassStiffnessGainAndDampingChangesForcesAlone) {
  const StudyHopper hopper = SomeHopper();
  StudyHopper heavier = hopper;
  for (const C c : {C::kMass, C::kBendingStiffness, C::kGain, C::kDampingScale})
    At(heavier.constants, c) *= 2.0;
  const EnergyCell cell{DegToRad(30.0), 3.0, 0.0};
  // The section's thickness goes with the cube root: axial and shear strain are not scaled alike.
  EXPECT_NEAR(*EnergyPercent(hopper, cell), *EnergyPercent(heavier, cell), 0.02);
  const ControlledSettings settings{.damping_N_s_per_m = 6.0};
  const ControlledRun one = RunControlled(hopper, settings), two = RunControlled(heavier, settings);
  ASSERT_FALSE(std::isnan(one.k_max_N_per_m));
  EXPECT_NEAR(two.k_max_N_per_m / one.k_max_N_per_m, 2.0, 0.02);
  EXPECT_NEAR(two.k_min_N_per_m / one.k_min_N_per_m, 2.0, 0.02);
}

TEST(StudyModel, StiffnessRangeHoldsTheUnloadedLegAtTouchdown) {
  const StudyHopper hopper = SomeHopper();
  const ControlledRun run = RunControlled(hopper, {.damping_N_s_per_m = 6.0});
  SimulationRequest request;
  request.law = Law::kThesis;
  Parameters<double>& p = request.parameters;
  const StudySection section = SectionOf(At(hopper.constants, C::kBendingStiffness));
  p.E = 22e9;
  p.G = 4e9;
  p.I = section.second_moment_m4;
  p.A = section.area_m2;
  p.r = At(hopper.constants, C::kRadius);
  const double theta = DegToRad(40.0);
  const double at_touchdown = StanceStiffness(request, theta, 2.0 * p.r * std::cos(0.5 * theta));
  EXPECT_LE(run.k_min_N_per_m, at_touchdown * (1.0 + 1e-4));
  EXPECT_GE(run.k_max_N_per_m, at_touchdown * (1.0 - 1e-4));
  EXPECT_LT(run.k_min_N_per_m, run.k_max_N_per_m);
}

TEST(StudyModel, ARunThatFallsIsMissingAndNotZero) {
  StudyHopper hopper = SomeHopper();
  At(hopper.constants, C::kMass) = 5.0;
  At(hopper.constants, C::kBendingStiffness) = 0.3;  // the body falls through the leg
  EXPECT_FALSE(EnergyPercent(hopper, {DegToRad(25.0), 0.0, 0.0}).has_value());
  const ControlledRun run = RunControlled(hopper, {});
  EXPECT_FALSE(IsComplete(run.outcome));
  EXPECT_TRUE(std::isnan(run.k_min_N_per_m));
  EXPECT_FALSE(run.convergence.converged());
}

TEST(StudyData, ThePublishedTablesHaveTheirCells) {
  const StudyData data = PublishedStudyData();
  ASSERT_EQ(data.energy.size(), 15U);
  EXPECT_EQ(data.energy.front().percent, 103.12);
  ASSERT_EQ(data.modulus.size(), 20U);
  EXPECT_TRUE(std::isnan(data.modulus[3].k_min_N_per_m));  // 21.4 GPa, undamped: no convergence
  EXPECT_EQ(data.modulus.back().k_max_N_per_m, 6500.0);
  ASSERT_EQ(data.starts.size(), 25U);
}

TEST(AllReadings, AreAllCombinationsOnce) {
  const std::vector<StudyReading> readings = AllReadings();
  EXPECT_EQ(readings.size(), 192U);  // 2^5 of two words, 3 damping rates, 2 lift-off rules
  for (std::size_t i = 0; i < readings.size(); ++i)
    EXPECT_EQ(std::count(readings.begin(), readings.end(), readings[i]), 1) << i;
  EXPECT_EQ(readings.front(), StudyReading());
}

// Tables made from constants and a reading that the identification is not told.
TEST(Identification, FindsTheReadingAndTheConstantsThatMadeTheTables) {
  StudyHopper truth = SomeHopper();
  truth.reading.variant.angle_rate = ThesisVariant::AngleRate::kVirtualLeg;
  truth.reading.variant.stiffness_radius = ThesisVariant::StiffnessRadius::kRest;
  std::vector<StudyReading> readings(4);
  readings[1] = truth.reading;
  readings[2].variant.rolling = ThesisVariant::Rolling::kExplicit;
  readings[3].variant.stiffness_angle = ThesisVariant::StiffnessAngle::kVirtualLeg;
  const IdentificationRequest request = RequestFor(TablesOf(truth), readings);
  const IdentificationResult result = Identify(request);
  EXPECT_EQ(result.by_energy.front().reading, truth.reading);
  EXPECT_LT(result.best_by_energy.scores.energy_rms, 0.02);
  const StudyFit& best = result.by_all.front().fit;
  EXPECT_EQ(best.reading, truth.reading);
  for (const C c : {C::kMass, C::kRadius, C::kBendingStiffness, C::kStartSpeed})
    EXPECT_NEAR(At(best.constants, c) / At(truth.constants, c), 1.0, 0.03) << InfoOf(c).name;
  EXPECT_NEAR(At(best.constants, C::kGain) / At(truth.constants, C::kGain), 1.0, 0.1);
  EXPECT_LT(result.by_all.front().scores.stiffness_worst, 0.01);
  // The other readings do visibly worse on what the truth prints to a hundredth of a point.
  EXPECT_GT(result.by_energy[1].misfit, 10.0 * result.by_energy[0].misfit);
}

TEST(Identification, DoesNotDependOnTheNumberOfThreads) {
  IdentificationRequest request = RequestFor(TablesOf(SomeHopper()), std::vector<StudyReading>(2));
  request.readings[1].liftoff = LiftoffRule::kRestLength;
  request.data.energy.resize(3);
  request.budget = 25;
  const IdentificationResult one = Identify(request);
  request.jobs = 3;
  const IdentificationResult three = Identify(request);
  ASSERT_EQ(one.by_all.size(), three.by_all.size());
  for (std::size_t i = 0; i < one.by_all.size(); ++i) {
    EXPECT_EQ(one.by_all[i].fit.reading, three.by_all[i].fit.reading);
    EXPECT_EQ(one.by_all[i].fit.constants, three.by_all[i].fit.constants);
  }
  EXPECT_EQ(one.evaluations, three.evaluations);
}

TEST(LeastSquares, SolvesRosenbrocksValleyWithinBounds) {
  LeastSquaresRequest request;
  request.residual_count = 2;
  request.start = Eigen::Vector2d(-1.2, 1.0);
  request.lower = Eigen::Vector2d(-3.0, -3.0);
  request.upper = Eigen::Vector2d(3.0, 3.0);
  request.evaluate = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    r[0] = 10.0 * (x[1] - x[0] * x[0]);
    r[1] = 1.0 - x[0];
    if (jacobian) *jacobian << -20.0 * x[0], 10.0, -1.0, 0.0;
    return true;
  };
  const LeastSquaresResult free = SolveLeastSquares(request);
  EXPECT_EQ(free.status, LeastSquaresResult::Status::kConverged);
  EXPECT_NEAR(free.x[0], 1.0, 1e-8);
  EXPECT_NEAR(free.x[1], 1.0, 1e-8);
  request.upper[0] = 0.5;
  EXPECT_NEAR(SolveLeastSquares(request).x[0], 0.5, 1e-8);
  request.evaluate = [](const auto&, auto&, auto*) { return false; };
  EXPECT_EQ(SolveLeastSquares(request).status, LeastSquaresResult::Status::kNoStart);
}

TEST(BoxSearch, FindsTheDeepestOfManyDips) {
  BoxSearchRequest request;
  request.low = {-5.12, -5.12};
  request.high = {5.12, 5.12};
  request.budget = 4000;
  request.cost = [](std::span<const double> x) {  // Rastrigin's function, least at 0.4, -1.3
    double sum = 20.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double d = x[i] - (i == 0 ? 0.4 : -1.3);
      sum += d * d - 10.0 * std::cos(2.0 * M_PI * d);
    }
    return sum;
  };
  const BoxSearchResult found = SearchBox(request);
  ASSERT_EQ(found.x.size(), 2U);
  EXPECT_NEAR(found.x[0], 0.4, 1e-4);
  EXPECT_NEAR(found.x[1], -1.3, 1e-4);
  EXPECT_LE(found.evaluations, 4000);
  EXPECT_EQ(SearchBox(request).x, found.x);
}

}  // namespace
}  // namespace hoplab
