#include "optimize/stride_map.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "optimize/continuation.h"
#include "optimize/stride_measures.h"
#include "tests/support/robot_gaits.h"

// The return map of a robot with a clock, section 7 of the equation sheet.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

// A difference quotient of the map alone, extrapolated (Richardson). Shares nothing with the
// sensitivities.
SectionState Difference(StrideMap& map, const SectionState& at, Eigen::Index k, double step) {
  const auto quotient = [&](double h) {
    SectionState up = at, down = at;
    up[k] += h;
    down[k] -= h;
    return SectionState((map.Apply(up).next - map.Apply(down).next) / (2.0 * h));
  };
  return (4.0 * quotient(0.5 * step) - quotient(step)) / 3.0;
}

Eigen::MatrixXd DifferenceJacobian(StrideMap& map, const SectionState& at) {
  const std::vector<SectionComponent> components = map.Components(at);
  Eigen::MatrixXd J(at.size(), at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k)
    J.col(k) = Difference(map, at, k, 1e-5 * components[static_cast<std::size_t>(k)].size);
  return J;
}

// A run that is cut in two, at a place where feet stand, is the run that is not.
TEST(StrideMap, ARunGoesOnAsIfItHadNotStopped) {
  const Hopper hopper = WalkingRobot();
  const double period = hopper.request.parameters.robot->period;
  double worst = 0.0;
  for (const double cut : {0.9, 1.35, 2.2}) {
    SimulationRequest whole = RequestOf(hopper);
    whole.horizon = cut * period;
    const Trajectory first = Simulate(whole);
    whole.horizon = 3.0 * period;
    const Trajectory uncut = Simulate(whole);
    ASSERT_EQ(uncut.outcome, Outcome::kCompleted);
    SimulationRequest second = RequestOf(hopper);
    second.parameters.time_origin = first.end_time;
    second.initial = first.final_state;
    second.feet = first.final_feet;
    second.horizon = 3.0 * period - first.end_time;
    const Trajectory rest = Simulate(second);
    ASSERT_EQ(rest.outcome, Outcome::kCompleted);
    ASSERT_EQ(rest.final_feet, uncut.final_feet);
    for (std::size_t i = 0; i < uncut.final_state.size(); ++i) {
      EXPECT_NEAR(rest.final_state[i], uncut.final_state[i], 1e-7) << cut << " " << i;
      worst = std::max(worst, std::abs(rest.final_state[i] - uncut.final_state[i]));
    }
  }
  std::printf("  a run cut in two: %.1e from the uncut one\n", worst);
}

struct GaitCase {
  const char* name;
  Hopper hopper;
  bool stands;  // a foot holds at the section
  ParameterId stiffness = ParameterId::kE;
};

class SteadyStrides : public ::testing::TestWithParam<int> {
 protected:
  static GaitCase Case() {
    if (GetParam() == 0) return {"pronk", PronkingRobot(), false};
    if (GetParam() == 1) return {"walk", WalkingRobot(), true};
    return {"walk on straight legs", WalkingOnRods(), true, ParameterId::kStiffness};
  }
};

TEST_P(SteadyStrides, ComesBackToItself) {
  const GaitCase gait = Case();
  SteadyStride steady = FindSteadyStride(gait.hopper);
  ASSERT_TRUE(steady.point.found()) << gait.name;
  StrideMap& map = *steady.start.map;
  const Hop hop = map.Apply(steady.point.state);
  EXPECT_LT((hop.next - steady.point.state).norm(), 1e-8);
  EXPECT_GT(hop.advance, 0.05);
  EXPECT_EQ(std::any_of(map.feet().begin(), map.feet().end(),
                        [](const Foot& foot) { return foot.Holds(); }),
            gait.stands);
  // Where it is stable, ten more strides of the plain simulation lead nowhere else.
  if (!steady.point.stable()) return;
  SectionState z = steady.point.state;
  for (int stride = 0; stride < 10; ++stride) z = map.Apply(z).next;
  EXPECT_LT((z - steady.point.state).norm(), 1e-7);
}

TEST_P(SteadyStrides, MultipliersAreThoseOfDifferences) {
  const GaitCase gait = Case();
  SteadyStride steady = FindSteadyStride(gait.hopper);
  ASSERT_TRUE(steady.point.found());
  StrideMap& map = *steady.start.map;
  const Eigen::MatrixXd J = DifferenceJacobian(map, steady.point.state);
  const Eigen::MatrixXd exact = map.Differentiate(steady.point.state).jacobian;
  EXPECT_LT((J - exact).norm(), 1e-6 * exact.norm()) << gait.name;
  Eigen::VectorXcd oracle = J.eigenvalues();
  double worst = 0.0;
  for (const std::complex<double>& m : steady.point.multipliers)
    worst = std::max(worst, (oracle.array() - m).abs().minCoeff());
  std::printf("  %s: multipliers %.1e from differences, largest %.4f\n", gait.name, worst,
              steady.point.spectral_radius);
  EXPECT_LT(worst, 1e-5);
  EXPECT_EQ(steady.point.multipliers.size(), static_cast<std::size_t>(exact.rows()));
}

TEST_P(SteadyStrides, AnswersTheClockAsDifferencesDo) {
  const GaitCase gait = Case();
  SteadyStride steady = FindSteadyStride(gait.hopper);
  ASSERT_TRUE(steady.point.found());
  StrideMap& map = *steady.start.map;
  const std::vector<D> directions = {
      D::Parameter(ParameterId::kClockPeriod), D::Parameter(ParameterId::kClockDuty),
      D::Parameter(ParameterId::kClockSweep),  D::Parameter(ParameterId::kClockOffset),
      D::Parameter(ParameterId::kClockPhase2), D::Parameter(gait.stiffness),
      D::Parameter(ParameterId::kMotorKp)};
  const Hop hop = map.Differentiate(steady.point.state, directions);
  ASSERT_TRUE(hop.ok());
  double worst = 0.0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double value = ValueOf(map.hopper(), directions[i]);
    const auto quotient = [&](double h) {
      SetValue(map.hopper(), directions[i], value + h);
      const SectionState up = map.Apply(steady.point.state).next;
      SetValue(map.hopper(), directions[i], value - h);
      const SectionState down = map.Apply(steady.point.state).next;
      SetValue(map.hopper(), directions[i], value);
      return SectionState((up - down) / (2.0 * h));
    };
    const double step = 2e-6 * ScaleOf(map.hopper(), directions[i]);
    const SectionState oracle = (4.0 * quotient(0.5 * step) - quotient(step)) / 3.0;
    const SectionState exact = hop.by_parameter.col(static_cast<Eigen::Index>(i));
    EXPECT_LT((oracle - exact).norm(), 3e-5 * exact.norm())
        << gait.name << " " << InfoOf(directions[i].parameter).name;
    worst = std::max(worst, (oracle - exact).norm() / exact.norm());
  }
  std::printf("  %s: derivatives by the clock, stiffness and kp %.1e from differences\n", gait.name,
              worst);
}

std::string NameOfGait(const ::testing::TestParamInfo<int>& at) {
  return at.param == 0 ? "pronk" : at.param == 1 ? "walk" : "walk_on_rods";
}
INSTANTIATE_TEST_SUITE_P(Gaits, SteadyStrides, ::testing::Values(0, 1, 2), NameOfGait);

TEST(StrideMap, ARobotThatFallsSoonHasNoSection) {
  Hopper hopper = PronkingRobot();
  hopper.request.initial[4] = 1.3;  // nose up
  const StrideStart start = StartStrides(hopper, 20);
  EXPECT_FALSE(start.map.has_value());
  EXPECT_EQ(start.outcome, Outcome::kFellPitch);
  EXPECT_LT(start.strides, 3.0);
  const SteadyStride steady = FindSteadyStride(hopper);
  EXPECT_FALSE(steady.point.found());
}

// Uphill and downhill: the height gained is taken off, and the gait there is another one.
TEST(StrideMap, ClimbsASlopeSteadily) {
  Hopper hopper = WalkingRobot();
  hopper.request.parameters.slope = 0.02;
  const SteadyStride steady = FindSteadyStride(hopper);
  ASSERT_TRUE(steady.point.found());
  const SimulationRequest stride = steady.start.map->RequestFrom(steady.point.state);
  const Trajectory run = Simulate(stride);
  EXPECT_NEAR(run.final_state[1] - steady.point.state[0], std::tan(0.02) * steady.point.hop.advance,
              1e-8);
  const SteadyStride level = FindSteadyStride(WalkingRobot());
  EXPECT_LT(MeasureStride(*level.start.map, level.point.state).cost_of_transport,
            MeasureStride(*steady.start.map, steady.point.state).cost_of_transport);
}

TEST(StrideMeasures, TellGaitsApart) {
  const SteadyStride pronk = FindSteadyStride(PronkingRobot());
  const StrideMeasures high = MeasureStride(*pronk.start.map, pronk.point.state);
  EXPECT_EQ(high.kind, GaitKind::kPronk);
  EXPECT_GT(high.flight_share, 0.1);
  const SteadyStride walk = FindSteadyStride(WalkingRobot());
  const StrideMeasures low = MeasureStride(*walk.start.map, walk.point.state);
  EXPECT_NE(low.kind, GaitKind::kPronk);
  EXPECT_NEAR(low.legs[1].middle, 0.5, 0.2);  // the middle leg half a turn behind
  EXPECT_NEAR(low.speed, walk.point.hop.advance / walk.point.hop.period, 1e-12);
  EXPECT_LE(low.peak_torque, WalkingRobot().request.parameters.robot->torque_limit + 1e-12);
}

// The motors' work of a stride is what the legs' damping, the feet and the slope take: at a fixed
// point the energy is the same after it. Its positive part is at least the whole.
TEST(StrideMeasures, PositiveWorkIsNoLessThanWhatAClimbTakes) {
  Hopper hopper = WalkingRobot();
  hopper.request.parameters.slope = 0.02;
  const SteadyStride steady = FindSteadyStride(hopper);
  ASSERT_TRUE(steady.point.found());
  EXPECT_GT(MeasureStride(*steady.start.map, steady.point.state).cost_of_transport, std::sin(0.02));
}

// The branch along the period passes through the steady stride found at another period.
TEST(StrideMap, IsFollowedAlongThePeriod) {
  Hopper hopper = WalkingRobot();
  hopper.request.integrator = {};
  SteadyStride steady = FindSteadyStride(hopper);
  ASSERT_TRUE(steady.point.found());
  const double period = hopper.request.parameters.robot->period;
  ContinuationOptions options{
      .low = 0.99 * period, .high = 1.01 * period, .first_step = 0.4, .max_step = 0.5};
  options.fixed_point.tolerance = kStrideResidual;
  const Branch branch = FollowFixedPoint(*steady.start.map, steady.point,
                                         D::Parameter(ParameterId::kClockPeriod), options);
  ASSERT_GT(branch.points.size(), 2u);
  const BranchPoint& last = branch.points.back();
  EXPECT_GT(last.parameter, period);
  StrideMap there = *steady.start.map;
  SetValue(there.hopper(), D::Parameter(ParameterId::kClockPeriod), last.parameter);
  const Hop hop = there.Apply(last.fixed_point.state);
  ASSERT_TRUE(hop.ok());
  EXPECT_LT((hop.next - last.fixed_point.state).norm(), 1e-7);
  EXPECT_NEAR(hop.period, last.parameter, 1e-12);
}

}  // namespace
}  // namespace hoplab
