#include "fitting/diagnosis/energy_ledger.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fitting/apex_segments.h"
#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

// The true model of generated hops.
FittedModel TrueModel(FitProblem problem) {
  FittedModel model;
  model.problem = std::move(problem);
  model.shared.resize(2);
  model.shared << testing::HopTruth().E_Pa, testing::HopTruth().damping_N_s_per_m;
  for (const TrialProblem& t : TrialsOf(model.problem, TrialRole::kTrain))
    model.initial_states.push_back(t.start);
  model.status = SolveStatus::kConverged;
  return model;
}

// 1 mm of noise, averaged over a dozen rows of an arc, moves an energy by a few mJ.
constexpr double kEnergyError_J = 0.03;

TEST(EnergyLedger, TheTraceAndTheTrueModelLoseTheSameEnergy) {
  const FittedModel model = TrueModel(MakeProblem(testing::SmallDataset(), {}));
  const HeldOutErrors errors = MeasureHeldOut(model, 1);
  const EnergyLedger ledger = LedgerOf(model, errors, nullptr);
  EXPECT_EQ(ledger.recording, "test-7.csv") << "a held-out one where there is any";
  ASSERT_GE(ledger.hops.size(), 1u);
  for (const HopEnergy& hop : ledger.hops) {
    EXPECT_NEAR(hop.measured.begin, hop.before.begin, kEnergyError_J);
    EXPECT_NEAR(hop.measured.end, hop.before.end, kEnergyError_J);
    EXPECT_GT(hop.before.LossShare(), 0.01) << "the damper takes energy";
    EXPECT_FALSE(hop.after.has_value());
  }
}

TEST(EnergyLedger, BodyEnergyIsWeightTimesHeightAndHalfTheSquareOfSpeed) {
  const FittedModel model = TrueModel(MakeProblem(testing::SmallDataset(), {}));
  const HeldOutErrors errors = MeasureHeldOut(model, 1);
  const EnergyLedger ledger = LedgerOf(model, errors, &errors);
  ASSERT_FALSE(ledger.hops.empty());
  const TrialErrors& trial = errors.trials.back();
  const double y = trial.start[1], vx = trial.start[2], vy = trial.start[3];
  // Read off the simulated channels, which are exact parabolas there.
  EXPECT_NEAR(ledger.hops[0].before.begin, 9.81 * y + 0.5 * (vx * vx + vy * vy), 1e-6);
  EXPECT_EQ(ledger.hops[0].after->begin, ledger.hops[0].before.begin);
}

TEST(EnergyLedger, SingleHopsBeginAtTheirOwnInitialStates) {
  const FittedModel model = TrueModel(SplitIntoHops(MakeProblem(testing::SmallDataset(), {})));
  const HeldOutErrors errors = MeasureHeldOut(model, 1);
  const EnergyLedger ledger = LedgerOf(model, errors, nullptr);
  ASSERT_FALSE(ledger.hops.empty());
  for (const HopEnergy& hop : ledger.hops) {
    EXPECT_NEAR(hop.measured.begin, hop.before.begin, kEnergyError_J);
    EXPECT_NEAR(hop.measured.end, hop.before.end, kEnergyError_J);
  }
}

TEST(EnergyLedger, IsEmptyWithoutHeights) {
  Dataset d = testing::SmallDataset();
  d.channels.pop_back();  // body_y_m
  const FittedModel model = TrueModel(MakeProblem(d, {}));
  EXPECT_TRUE(LedgerOf(model, MeasureHeldOut(model, 1), nullptr).hops.empty());
}

// Half of what a hop's energy is of may be speed along the ground.
TEST(EnergyLedger, IsEmptyWhereNothingShowsTheSpeedAlongTheGround) {
  Dataset d = testing::SmallDataset();
  d.channels.erase(d.channels.begin());  // body_x_m
  const FittedModel model = TrueModel(MakeProblem(d, {}));
  EXPECT_TRUE(LedgerOf(model, MeasureHeldOut(model, 1), nullptr).hops.empty());
}

}  // namespace
}  // namespace hoplab
