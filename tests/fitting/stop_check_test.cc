// Where a search has ended: what the linear model still promises there.
#include "fitting/stop_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

// A little off the minimum the promised step leads back to it, and the gain is what the costs say.
TEST(StopCheck, ThePromisedStepLeadsBackToTheMinimum) {
  const testing::SmallFit fit;
  const SolveResult at = Solve(fit.Request());
  Eigen::VectorXd off = at.shared;
  off[0] *= 1.0 + 1e-4;
  off[1] += 1e-3;
  const StopCheck stop = CheckStop(fit.problem, fit.trials, off, at.initial_states, {}, 1);
  EXPECT_NEAR(stop.promised_step[0], at.shared[0] - off[0], 0.02 * (off[0] - at.shared[0]));
  EXPECT_NEAR(stop.promised_step[1], at.shared[1] - off[1], 0.02 * (off[1] - at.shared[1]));
  SolveRequest held = fit.Request();
  held.shared = off;
  held.initial_states = at.initial_states;
  held.hold_shared = held.hold_initial_states = true;
  EXPECT_NEAR(stop.promised_nats, Solve(held).cost - at.cost, 0.02 * stop.promised_nats);
}

TEST(StopCheck, APromiseIsToldInStandardErrors) {
  StopCheck stop;
  stop.complete = true;
  stop.promised_nats = 2.0;
  stop.promised_step = Eigen::Vector3d(1e6, -3e-6, 5.0);
  stop.faults = {"it still gets better"};
  EXPECT_TRUE(stop.OnlyPromises());
  const Eigen::Vector3d errors(1e8, 1e-5, std::nan(""));
  ASSERT_TRUE(stop.PromisedErrors(errors, 25000.0));
  EXPECT_DOUBLE_EQ(*stop.PromisedErrors(errors, 25000.0), 0.3);
  // Of a small cost the same is much: the search ended elsewhere.
  EXPECT_FALSE(stop.PromisedErrors(errors, 1000.0));
  EXPECT_FALSE(stop.PromisedErrors(Eigen::Vector3d::Constant(std::nan("")), 25000.0));
}

TEST(StopCheck, OtherFaultsAreNoPromise) {
  StopCheck stop;
  stop.complete = true;
  stop.promised_nats = 2.0;
  stop.faults = {"it still gets better", "E ended at the end of its range"};
  EXPECT_FALSE(stop.OnlyPromises());
  stop.faults.pop_back();
  stop.complete = false;
  EXPECT_FALSE(stop.OnlyPromises());
}

}  // namespace
}  // namespace hoplab
