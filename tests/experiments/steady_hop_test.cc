#include "experiments/identification/steady_hop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/experiments/study_hoppers.h"

namespace hoplab {
namespace {

using namespace testing;

TEST(SteadyHop, IsWhereTheRunsEnd) {
  const StudyHopper hopper = SomeHopper();
  const SteadyHop steady = FindSteadyHop(hopper, kStudyModulus, 6.0);
  ASSERT_TRUE(steady.point.stable());
  const ControlledRun run =
      RunControlled(hopper, {.damping_N_s_per_m = 6.0}, {.stiffness = true, .fixed_speed = true});
  EXPECT_NEAR(run.speeds.apex.back().vx, steady.point.state[0], 1e-4);
  EXPECT_NEAR(run.fixed_speed_m_per_s, steady.point.state[0], 1e-6);
  const ControlledRun predicted =
      PredictControlled(hopper, {.damping_N_s_per_m = 6.0}, steady.point, {.stiffness = true});
  EXPECT_NEAR(predicted.k_min_N_per_m / run.k_min_N_per_m, 1.0, 1e-3);
  EXPECT_NEAR(predicted.k_max_N_per_m / run.k_max_N_per_m, 1.0, 1e-3);
}

// The linear map after two real hops: times to a hop or two, which a search can begin with.
TEST(SteadyHop, PredictsTheTimesOfTheRunsToAboutAHop) {
  const StudyHopper hopper = SomeHopper();
  const SteadyHop steady = FindSteadyHop(hopper, kStudyModulus, 6.0);
  ASSERT_TRUE(steady.point.stable());
  double off = 0.0;
  int count = 0;
  for (const double speed : {0.8, 1.0, 1.2}) {
    for (const double height : {0.25, 0.3, 0.35}) {
      const ControlledSettings settings{
          .damping_N_s_per_m = 6.0, .speed_m_per_s = speed, .height_m = height};
      for (const ConvergenceReading& reading :
           {ConvergenceReading{}, {.speed = ConvergenceReading::Speed::kApex}}) {
        const double predicted =
            PredictControlled(hopper, settings, steady.point).TimeBy(reading).time;
        const double real = RunControlled(hopper, settings).TimeBy(reading).time;
        ASSERT_FALSE(std::isnan(predicted)) << speed << ' ' << height;
        off += std::abs(predicted - real);
        ++count;
      }
    }
  }
  EXPECT_LT(off / count, 2.0 * steady.point.hop.period);
}

TEST(SteadyHop, AHopperThatFallsHasNone) {
  StudyHopper hopper = SomeHopper();
  At(hopper.constants, StudyConstant::kMass) = 5.0;
  At(hopper.constants, StudyConstant::kBendingStiffness) = 0.3;
  const SteadyHop steady = FindSteadyHop(hopper, kStudyModulus, 6.0);
  EXPECT_FALSE(steady.point.stable());
  EXPECT_FALSE(IsComplete(steady.start.outcome));
  const StudyData data = TablesOf(SomeHopper(), {}, 3);
  const StudyRuns runs = RunSteady(hopper, SteadyData(data, false), {});
  for (const ControlledRun& run : runs.initial_states) EXPECT_FALSE(run.TimeBy({}).converged());
}

}  // namespace
}  // namespace hoplab
