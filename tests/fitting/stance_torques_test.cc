// A logged torque that is none in flight and there one row after a touch-down.
#include "fitting/stance_torques.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"

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

}  // namespace
}  // namespace hoplab
