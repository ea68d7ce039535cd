#include <gtest/gtest.h>

#include "datasets/read_scenario.h"
#include "fitting/diagnosis/candidate.h"
#include "fitting/fit.h"
#include "fitting/generate.h"
#include "fitting/uncertainty.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;

// The shipped scenario of a leg with a toe mass, generated, with other nominal values to fit from.
Dataset ToeMassDataset(double nominal_mass) {
  const Scenario scenario =
      ReadScenario(std::filesystem::path(HOPLAB_SOURCE_DIR) / "experiments/toe-mass.yaml", {});
  Dataset dataset = GenerateDataset(scenario, {.seed = 11}).dataset;
  const auto change = [&](MechanismSpec& mechanism) {
    mechanism.toe_mass_kg = nominal_mass;
    mechanism.c_leg.E_Pa = 20e9;
  };
  change(dataset.mechanism);
  for (Trial& trial : dataset.trials) change(trial.mechanism);
  return dataset;
}

TEST(ToeMassFit, FindsMassAndModulusOfGeneratedHops) {
  const FitProblem problem = MakeProblem(ToeMassDataset(0.012), {.free = {"E", "d", "m_toe"}});
  EXPECT_EQ(problem.leg_mass(), LegMass::kAtToe);
  const FitResult fit = Fit(problem, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  const Uncertainty known = AssessUncertainty(problem, TrialsOf(problem, TrialRole::kTrain),
                                              fit.shared, fit.initial_states, {}, 1);
  const double truth[] = {22e9, 3.0, 0.02};
  for (int i = 0; i < 3; ++i) {
    // Five standard errors: one seed in two million misses.
    const double error = known.parameters[i].std_error.value();
    EXPECT_NEAR(fit.shared[i], truth[i], 5.0 * error) << i;
    EXPECT_LT(error, 0.05 * truth[i]) << i;
  }
}

TEST(ToeMassFit, AMasslessLegHasNoToeMassToFree) {
  EXPECT_EQ(
      InputErrorOf([] {
        MakeProblem(ToeMassDataset(0.0), {.free = {"E", "m_toe"}});
      }),
      "--free: m_toe; belongs to a leg with a toe mass, and this one has none. Add toe_mass_kg "
      "to the mechanism.");
}

TEST(ToeMassFit, AnEffectThatIsNotModelledThereIsRefusedAndNoCandidate) {
  const Dataset dataset = ToeMassDataset(0.02);
  EXPECT_EQ(InputErrorOf([&] { MakeProblem(dataset, {.with_effects = {"torque_lag"}}); }),
            "--with: effect torque_lag; does not apply to a leg with a toe mass. Leave it or "
            "toe_mass_kg out.");
  for (const Candidate& candidate : CandidatesOf(MakeProblem(dataset, {}), {}))
    EXPECT_NE(candidate.effect->info.name, "torque_lag");
}

TEST(ToeMassFit, PlacementComesFromTheDescription) {
  const FitProblem problem = MakeProblem(ToeMassDataset(0.02), {});
  EXPECT_EQ(problem.shared_names(), (std::vector<std::string>{"E", "d"}));
  EXPECT_EQ(problem.trials[0].parameters.m_toe, 0.02);
  EXPECT_EQ(problem.trials[0].parameters.kp_place, 4.0);
  EXPECT_EQ(problem.trials[0].parameters.kd_place, 0.08);
}

}  // namespace
}  // namespace hoplab
