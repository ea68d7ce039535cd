#include <gtest/gtest.h>

#include <array>

#include "model/integrators/dop853.h"
#include "tests/support/matrix_near.h"
#include "tests/support/requests.h"

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

const std::array<D, 4> kIntegratedDirections = {D::InitialState(1), D::InitialState(2),
                                                D::Parameter(ParameterId::kE),
                                                D::Parameter(ParameterId::kThetaTd)};

Trajectory RunWithSolver(SimulationRequest q, IntegratorKind kind, double tolerance) {
  q.integrator = {kind, tolerance, 0.1 * tolerance};
  return Simulate(q);
}
// With E scaled so that its column compares with the others.
std::vector<double> Columns(const SimulationRequest& q, const Trajectory& run) {
  std::vector<double> all = run.final_sensitivities;
  all.insert(all.end(), run.event_time_sensitivities.begin(), run.event_time_sensitivities.end());
  for (std::size_t i = 2; i < all.size(); i += 4) all[i] *= q.parameters.E;
  return all;
}
std::vector<double> Times(const Trajectory& run) {
  std::vector<double> times;
  for (const Event& e : run.events) times.push_back(e.time);
  return times;
}

// y' = -c/(y - s), s' = 30: where s has come to y the rate has no bound, and from both sides y is
// thrown at s. A solver that goes on with any step takes 1772 of them across it.
TEST(Dop853, EndsWhereTheRateHasNoBound) {
  const double units[] = {1.0, 1.0}, begin[] = {0.1, 0.0};
  const auto rates = [](const void*, double, const double* y, double* dy) {
    dy[0] = -1e-6 / (y[0] - y[1]);
    dy[1] = 30.0;
  };
  Dop853 stepper({}, {rates, nullptr, 2, 2, units});
  stepper.Start(0.0, begin, 1e-4);
  int steps = 0;
  while (steps < 5000 && stepper.Step(1.0) == StepStatus::kOk) ++steps;
  EXPECT_LT(steps, 100);
  EXPECT_NEAR(stepper.t1(), 0.1 / 30.0, 1e-7);
}

struct Solvers : ::testing::TestWithParam<Law> {};

// One-step methods err by a small multiple of the tolerance a step, over a dozen steps, and the
// leg magnifies position errors about tenfold from touch-down to apex.
constexpr double kOneStepAgreement = 1e3;
// Backward differentiation takes some 500 steps.
constexpr double kMultistepAgreement = 1e5;

TEST_P(Solvers, AgreeOnStateEventsAndSensitivities) {
  SimulationRequest q = ThickLegRequest(GetParam());
  q.directions = kIntegratedDirections;
  constexpr double kTolerance = 1e-10;
  const Trajectory reference = RunWithSolver(q, IntegratorKind::kDop853, kOracleRelative);
  for (auto [kind, factor] : {std::pair{IntegratorKind::kDop853, kOneStepAgreement},
                              std::pair{IntegratorKind::kErkStep, kOneStepAgreement},
                              std::pair{IntegratorKind::kCvodes, kMultistepAgreement}}) {
    const Trajectory run = RunWithSolver(q, kind, kTolerance);
    SCOPED_TRACE(NameOf(kind));
    ASSERT_EQ(EventNames(run), EventNames(reference));
    EXPECT_TRUE(MatrixNear(Times(run), Times(reference), factor * kTolerance));
    EXPECT_TRUE(MatrixNear(run.final_state, reference.final_state, factor * kTolerance));
    EXPECT_TRUE(MatrixNear(Columns(q, run), Columns(q, reference), factor * kTolerance));
  }
}

TEST_P(Solvers, AgreeOnRowsInsideAStance) {
  SimulationRequest q = ThickLegRequest(GetParam());
  const std::vector<double> times = EvenTimes(Simulate(q).end_time, 50);
  const std::array channels = {Channel::kBodyX, Channel::kBodyY, Channel::kBodyVx, Channel::kBodyVy,
                               Channel::kLegAngle};
  q.row_times = times;
  q.channels = channels;
  const Trajectory reference = RunWithSolver(q, IntegratorKind::kDop853, kOracleRelative);
  for (auto [kind, factor] : {std::pair{IntegratorKind::kDop853, kOneStepAgreement},
                              std::pair{IntegratorKind::kErkStep, kOneStepAgreement},
                              std::pair{IntegratorKind::kCvodes, kMultistepAgreement}}) {
    const Trajectory run = RunWithSolver(q, kind, 1e-10);
    EXPECT_TRUE(MatrixNear(run.samples, reference.samples, factor * 1e-10)) << NameOf(kind);
  }
}

TEST_P(Solvers, ErrorFallsWithTheTolerance) {
  const SimulationRequest q = ThickLegRequest(GetParam());
  const Trajectory reference = RunWithSolver(q, IntegratorKind::kDop853, kOracleRelative);
  for (IntegratorKind kind :
       {IntegratorKind::kDop853, IntegratorKind::kErkStep, IntegratorKind::kCvodes}) {
    for (double tolerance : {1e-5, 1e-7, 1e-9, 1e-11}) {
      const Trajectory run = RunWithSolver(q, kind, tolerance);
      EXPECT_TRUE(MatrixNear(run.final_state, reference.final_state, kOneStepAgreement * tolerance))
          << NameOf(kind) << ' ' << tolerance;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, Solvers, ::testing::ValuesIn(kCLegLaws),
                         [](const auto& info) { return std::string(NameOf(info.param)); });

// Dry friction turns over within a narrow band of speed: a step that meets it has to shrink.
TEST(SharpEffect, IsMetByEverySolver) {
  for (IntegratorKind kind : {IntegratorKind::kDop853, IntegratorKind::kErkStep}) {
    for (int i = 1; i <= 60; ++i) {
      SimulationRequest q;
      q.law = Law::kStraightLeg;
      q.parameters.m = 1.0;
      q.parameters.k = 2500.0;
      q.parameters.l0 = 0.18;
      q.parameters.d = 3.0;
      q.parameters.theta_td = Degrees(16.0);
      q.initial = {0.0, 0.33, 1.2, 0.0};
      q.horizon = 5.0;
      q.max_hops = 2;
      q.integrator = {kind, kOracleRelative, kOracleAbsolute};
      EffectSetting friction = EffectSetting::Null(*FindEffect("guide_coulomb_friction"));
      friction.values[0] = 0.005 * i;
      q.effects = {&friction, 1};
      EXPECT_EQ(Simulate(q).outcome, Outcome::kHopLimit)
          << NameOf(kind) << ' ' << 0.005 * i << " N";
    }
  }
}

TEST(StiffStance, CvodesNeedsFarFewerStepsThanAnExplicitMethod) {
  // d = 5e4 N s/m on 1 kg: the chord speed dies in 20 us, the stance lasts for good.
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.d = 5e4;
  q.parameters.theta_td = Degrees(40.0);
  q.horizon = 0.4;
  const Trajectory stiff = RunWithSolver(q, IntegratorKind::kCvodes, 1e-9);
  const Trajectory explicit_run = RunWithSolver(q, IntegratorKind::kDop853, 1e-9);
  ASSERT_EQ(EventNames(stiff), EventNames(explicit_run));
  EXPECT_EQ(stiff.outcome, explicit_run.outcome);
  EXPECT_TRUE(MatrixNear(stiff.final_state, explicit_run.final_state, 1e-6));
  std::printf("stiff stance: cvodes %ld steps, dop853 %ld steps (x 12), ends %s in %s\n",
              stiff.steps, explicit_run.steps, NameOf(stiff.outcome).data(),
              NameOf(stiff.final_mode).data());
  EXPECT_LT(5 * stiff.steps, 12 * explicit_run.steps);
}

TEST(StiffStance, SensitivitiesOfCvodesMatchTheExplicitOnes) {
  SimulationRequest q = ThickLegRequest(Law::kConsistent);
  q.parameters.d = 5e4;
  q.parameters.theta_td = Degrees(40.0);
  q.horizon = 0.25;
  q.directions = kIntegratedDirections;
  const Trajectory stiff = RunWithSolver(q, IntegratorKind::kCvodes, 1e-11);
  const Trajectory explicit_run = RunWithSolver(q, IntegratorKind::kDop853, 1e-11);
  EXPECT_TRUE(MatrixNear(Columns(q, stiff), Columns(q, explicit_run), 1e-6));
}

}  // namespace
}  // namespace hoplab
