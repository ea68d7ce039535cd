// A logged torque that is none in flight and there one row after a touch-down.
#include "fitting/stance_torques.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"
#include "datasets/touchdowns.h"
#include "fitting/fit.h"
#include "tests/support/driven_hops.h"

namespace hoplab {
namespace {

// Stances of 0.1 s every 0.4 s, torque(s) at time s of each, and noise of 0.02 N m.
FitProblem Logged(const std::function<double(double)>& torque) {
  constexpr int kTrials = 4;
  FitProblem problem;
  for (int i = 0; i < kTrials; ++i) {
    RandomStream random(9, static_cast<std::uint64_t>(i));
    DrivenColumn column{InputKind::kHipTorque};
    for (int row = 0; row < 600; ++row) {
      const double t = 0.002 * row, s = std::fmod(t, 0.4) - 0.3;
      column.times.push_back(t);
      column.values.push_back((s >= 0.0 ? torque(s) : 0.0) + 0.02 * random.Normal());
    }
    TrialProblem trial;
    trial.inputs = {column};
    problem.trials.push_back(trial);
  }
  return problem;
}

TEST(StanceTorques, AreToldWhereTheyStepIn) {
  FitProblem problem = Logged([](double s) { return 2.4 - 10.0 * s; });
  ASSERT_EQ(StanceTorques(problem).size(), 1u);
  EXPECT_NE(StanceTorques(problem)[0].find("`hold: stance`"), std::string::npos);
  EXPECT_NE(StanceTorques(problem)[0].find("has a part of it, "), std::string::npos);
  for (TrialProblem& trial : problem.trials) trial.inputs[0].held = true;
  EXPECT_NE(StanceTorques(problem)[0].find("has none, and then a blow"), std::string::npos);
  // In half of the trials it is told as the user wants it.
  for (std::size_t i = 0; i < 2; ++i) problem.trials[i].inputs[0].of_stance = true;
  EXPECT_TRUE(StanceTorques(problem).empty());
}

TEST(StanceTorques, ThatGrowFromNoneOrAreThereInFlightAreNot) {
  EXPECT_TRUE(StanceTorques(Logged([](double s) { return 20.0 * s; })).empty());
  FitProblem always = Logged([](double) { return 0.0; });
  for (TrialProblem& trial : always.trials)
    for (std::size_t i = 0; i < trial.inputs[0].values.size(); ++i)
      trial.inputs[0].values[i] = 1.0 + std::sin(37.0 * trial.inputs[0].times[i]);
  EXPECT_TRUE(StanceTorques(always).empty());
  EXPECT_TRUE(StanceTorques(FitProblem()).empty());
}

// A motor that gives the same in every stance, logged as none from some rows after the lift-off, or
// before it, to as many rows before the touch-down, or after it.
Dataset LoggedInStances(bool of_stance) {
  testing::DrivenHops hops;
  hops.ripple_N_m = 0.0;
  hops.torque_noise_N_m = 0.0;
  hops.held = true;
  Dataset dataset = testing::DrivenDataset(hops, 5);
  double above_m = 0.012;
  for (Trial& trial : dataset.trials) {
    trial.inputs[0].of_stance = of_stance;
    above_m = -above_m;
    const double least_m = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad) + above_m;
    const std::vector<double> y = *trial.trace.Find(Channel::kBodyY);
    for (TraceColumn& column : trial.trace.columns)
      if (column.name == trial.inputs[0].column)
        for (std::size_t row = 0; row < y.size(); ++row)
          if (y[row] > least_m) column.values[row] = 0.0;
  }
  return dataset;
}

TEST(StanceTorques, ThatAreHeldThroughFlightsDriveTheMotionWhereverTheLogEndsThem) {
  const FitProblem whole = MakeProblem(LoggedInStances(true), {});
  std::size_t rows = 0, none = 0;
  const FitProblem logged = MakeProblem(LoggedInStances(false), {});
  for (std::size_t i = 0; i < whole.trials.size(); ++i)
    for (std::size_t row = 0; row < whole.trials[i].inputs[0].values.size(); ++row, ++rows) {
      EXPECT_EQ(whole.trials[i].inputs[0].values[row], 0.3) << i << ' ' << row;
      none += logged.trials[i].inputs[0].values[row] == 0.0 ? 1 : 0;
    }
  EXPECT_GT(3 * none, rows);
  // As a log that has the torque in flight, too; without it the rows tell when the foot leaves.
  const FitResult fit = Fit(whole, {});
  EXPECT_EQ(fit.records[0].status, SolveStatus::kConverged);
  EXPECT_NEAR(fit.shared[0] / testing::HopTruth().E_Pa, 1.0, 0.01);
  EXPECT_GT(Fit(logged, {}).cost, 1.5 * fit.cost);
}

}  // namespace
}  // namespace hoplab
