// Hoppers whose recordings end in a fall, and models that fall where the hopper did not.

#include "fitting/carried_beginnings.h"

#include <gtest/gtest.h>

#include "fitting/fit_dataset.h"
#include "tests/support/hop_scenarios.h"

namespace hoplab {
namespace {

using testing::HopScenario;
using testing::HopTruth;

constexpr double kDamping = 15.0;

// Passive hops until each hopper has lost so much that its leg finds no room to be placed: its body
// sinks past the ground. The recording goes on for 40 ms.
Dataset HopsToTheFall(std::uint64_t seed) {
  Scenario s = HopScenario(3, HopTruth{22e9, kDamping});
  s.stop.hops = 20;
  GenerateOptions options;
  options.seed = seed;
  Dataset d = GenerateDataset(s, options).dataset;
  for (Trial& t : d.trials) {
    t.mechanism.c_leg.damping_N_s_per_m = 12.0;
    std::vector<double> steps;
    for (const TraceColumn& c : t.trace.columns)
      steps.push_back((c.values.back() - c.values[c.values.size() - 6]) / 5.0);
    for (int row = 0; row < 10; ++row) {
      t.trace.time_s.push_back(t.trace.time_s.back() + 0.004);
      for (std::size_t c = 0; c < steps.size(); ++c)
        t.trace.columns[c].values.push_back(t.trace.columns[c].values.back() + steps[c]);
    }
  }
  d.mechanism.c_leg.damping_N_s_per_m = 12.0;
  return d;
}

long TrainRows(const FitProblem& problem) {
  long rows = 0;
  for (const TrialProblem& t : problem.trials)
    if (t.role == TrialRole::kTrain) rows += static_cast<long>(t.row_times.size());
  return rows;
}

TEST(CarriedBeginnings, OfHopsThatEndInAFallAreFittedAsWholeTraces) {
  const Dataset d = HopsToTheFall(3);
  const FitProblem problem = MakeProblem(d, {});
  const DatasetFit fit = FitTraces(problem, {});
  ASSERT_TRUE(fit.result.ok) << fit.result.message;
  EXPECT_TRUE(fit.result.stop.IsMinimum());
  EXPECT_FALSE(fit.by_hop) << fit.note;
  ASSERT_FALSE(fit.left_out.empty());
  EXPECT_NE(fit.left_out.front().find(".csv from "), std::string::npos) << fit.left_out.front();
  EXPECT_EQ(fit.problem.trials.size(), problem.trials.size());
  EXPECT_GE(TrainRows(fit.problem), 0.75 * TrainRows(problem));
  EXPECT_LT(TrainRows(fit.problem), TrainRows(problem));
  EXPECT_NEAR(fit.result.shared[0], 22e9, 0.01 * 22e9);
  EXPECT_NEAR(fit.result.shared[1], kDamping, 0.02 * kDamping);
}

TEST(CarriedBeginnings, EndInTheMiddleOfTheFlightBeforeTheSimulationEnds) {
  const FitProblem problem = MakeProblem(HopsToTheFall(3), {});
  const TrialProblem& trial = problem.trials.front();
  Trajectory run;
  run.outcome = Outcome::kFellAngle;
  run.end_time = 0.62;
  Event liftoff, touchdown;
  liftoff.kind = EventKind::kLiftoff;
  liftoff.time = 0.3;
  touchdown.kind = EventKind::kTouchdown;
  touchdown.time = 0.6;
  run.events = {touchdown, liftoff, touchdown};
  const auto in_stance = CarriedBeginning(problem, trial, run);
  ASSERT_TRUE(in_stance);
  EXPECT_NEAR(in_stance->row_times.back(), 0.45, 0.005);
  run.events = {touchdown, liftoff};
  run.end_time = 0.5;
  const auto in_flight = CarriedBeginning(problem, trial, run);
  ASSERT_TRUE(in_flight);
  EXPECT_NEAR(in_flight->row_times.back(), 0.4, 0.005);

  run.events = {touchdown};
  EXPECT_FALSE(CarriedBeginning(problem, trial, run)) << "no flight before the fall";
  run.events = {touchdown, liftoff};
  run.outcome = Outcome::kCompleted;
  EXPECT_FALSE(CarriedBeginning(problem, trial, run)) << "no fall";
}

}  // namespace
}  // namespace hoplab
